// SPDX-License-Identifier: MIT
#include "runtime/logs/text_rows.h"

#include <algorithm>
#include <array>
#include <map>

#include "runtime/recordings/columns.h"

namespace dyngen::runtime {
namespace {

/// A row has at least as many numbers as other words.
struct WordCounts {
  std::size_t values = 0, texts = 0, odd = 0;

  [[nodiscard]] bool is_row() const { return values > 0 && values >= texts; }
};

bool is_value(WordKind kind) { return kind == WordKind::kNumber || kind == WordKind::kTime; }

WordCounts count_words(const std::vector<std::string_view>& fields, char separator) {
  WordCounts counts;
  for (const std::string_view field : fields) {
    const WordKind kind = kind_of_word(field);
    if (is_value(kind)) ++counts.values;
    if (kind != WordKind::kText) continue;
    ++counts.texts;
    for (const char other : {',', ';', '\t', '|'}) {
      if (other != separator && field.find(other) != field.npos) {
        ++counts.odd;
        break;
      }
    }
  }
  return counts;
}

/// What most rows have in each field.
std::vector<WordKind> usual_kinds(const std::vector<std::vector<std::string_view>>& cut,
                                  const SampleRows& found) {
  constexpr std::size_t kKinds = 4;
  std::vector<std::array<std::size_t, kKinds>> counts(found.fields);
  for (const std::size_t row : found.rows) {
    for (std::size_t i = 0; i < found.fields; ++i) {
      ++counts[i][static_cast<std::size_t>(kind_of_word(cut[row][i]))];
    }
  }
  std::vector<WordKind> kinds;
  for (auto& count : counts) {
    // what is missing tells nothing of the others
    if (*std::max_element(count.begin() + 1, count.end()) > 0) count[0] = 0;
    kinds.push_back(
        static_cast<WordKind>(std::max_element(count.begin(), count.end()) - count.begin()));
  }
  return kinds;
}

/// Fields that most rows have. Where signals end one after another, rows become shorter: then
/// those of the rows before.
std::size_t usual_fields(const std::vector<std::vector<std::string_view>>& cut,
                         const std::vector<WordCounts>& counts) {
  std::map<std::size_t, std::size_t> rows_with, last_row;  ///< fields -> rows, the last of them
  for (std::size_t i = 0; i < cut.size(); ++i) {
    if (!counts[i].is_row()) continue;
    ++rows_with[cut[i].size()];
    last_row[cut[i].size()] = i;
  }
  std::size_t fields = 0, most = 0;
  for (const auto& [count, rows] : rows_with) {
    if (rows >= most) fields = count;  // of equals the larger one
    most = std::max(most, rows);
  }
  for (const auto& [longer, rows] : rows_with) {
    if (longer <= fields || rows < 2) continue;
    const std::size_t next = last_row[longer] + 1;
    bool shorter_follow = next < cut.size();
    for (std::size_t i = next; i < cut.size(); ++i) {
      shorter_follow = shorter_follow && counts[i].is_row() && cut[i].size() < longer;
    }
    if (shorter_follow) fields = longer;
  }
  return fields;
}

/// Names that happen to be numbers are no row of data: text stands where others have numbers.
bool fits_kinds(const std::vector<std::string_view>& fields, const std::vector<WordKind>& kinds) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (is_value(kinds[i]) && kind_of_word(fields[i]) == WordKind::kText) return false;
  }
  return true;
}

}  // namespace

std::vector<std::string_view> fields_of(std::string_view line, char separator, std::size_t fields) {
  std::vector<std::string_view> texts;
  for (const Field& field : split_fields(line, {separator})) texts.push_back(field.text);
  while (texts.size() > fields && texts.back().empty()) texts.pop_back();
  return texts;
}

std::optional<SampleRows> rows_by(char separator, const std::vector<SampleLine>& sample) {
  std::vector<std::vector<std::string_view>> cut;
  std::vector<WordCounts> counts;
  for (const SampleLine& line : sample) {
    cut.push_back(is_comment(line.text) ? std::vector<std::string_view>()
                                        : fields_of(line.text, separator, line.text.size() + 1));
    counts.push_back(count_words(cut.back(), separator));
  }
  const auto is_row = [](const WordCounts& words) { return words.is_row(); };
  if (std::none_of(counts.begin(), counts.end(), is_row)) return std::nullopt;
  SampleRows found;
  found.separator = separator;
  found.fields = usual_fields(cut, counts);
  for (std::size_t i = 0; i < sample.size(); ++i) {
    if (counts[i].is_row() && cut[i].size() == found.fields) found.rows.push_back(i);
  }
  found.column_kinds = usual_kinds(cut, found);
  // Rows begin where all that follow are like each other.
  const auto odd_one = [&](std::size_t row) { return !fits_kinds(cut[row], found.column_kinds); };
  const auto first = std::find_if_not(found.rows.begin(), found.rows.end(), odd_one);
  found.rows.erase(found.rows.begin(), first);
  if (found.rows.empty()) return std::nullopt;
  std::size_t words = 0, texts = 0, odd = 0;
  for (const std::size_t row : found.rows) {
    words += found.fields;
    texts += counts[row].texts;
    odd += counts[row].odd;
  }
  found.text_fields = static_cast<double>(texts) / static_cast<double>(words);
  found.odd_fields = static_cast<double>(odd) / static_cast<double>(words);
  const std::size_t begin = found.rows.front();
  found.header_fits =
      begin > 0 &&
      fields_of(sample[begin - 1].text, separator, found.fields).size() == found.fields;
  return found;
}

std::optional<SampleRows> best_rows(const std::vector<SampleLine>& sample,
                                    std::optional<char> separator) {
  if (separator) return rows_by(*separator, sample);
  std::optional<SampleRows> best;
  // Of equals the first is taken.
  for (const char candidate : {';', '\t', ',', '|', ' '}) {
    std::optional<SampleRows> found = rows_by(candidate, sample);
    if (!found) continue;
    const auto better = [&](const SampleRows& a, const SampleRows& b) {
      // "1,5" may be one number or two: two where as many names stand before
      const bool many_a = a.fields > 1, many_b = b.fields > 1;
      if (many_a != many_b && a.header_fits == b.header_fits) {
        const SampleRows &many = many_a ? a : b, &one = many_a ? b : a;
        if (2 * many.rows.size() >= one.rows.size()) return many_a;
      }
      // A few lines of prose may look like rows of another separator: a tenth decides.
      if (10 * a.rows.size() > 11 * b.rows.size()) return true;
      if (11 * a.rows.size() < 10 * b.rows.size()) return false;
      if (a.odd_fields != b.odd_fields) return a.odd_fields < b.odd_fields;
      if (a.header_fits != b.header_fits) return a.header_fits;
      if (many_a != many_b) return many_a;
      if (a.text_fields != b.text_fields) return a.text_fields < b.text_fields;
      return false;
    };
    if (!best || better(*found, *best)) best = std::move(found);
  }
  return best;
}

}  // namespace dyngen::runtime
