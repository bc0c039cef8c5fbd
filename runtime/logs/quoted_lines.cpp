// SPDX-License-Identifier: MIT
#include "runtime/logs/quoted_lines.h"

#include <string_view>

namespace dyngen::runtime {
namespace {

/// A field with more lines than this is taken for a stray quote.
constexpr std::size_t kMostLinesOfAField = 100;

bool may_separate(char c) { return c == ',' || c == ';' || c == '\t' || c == '|' || c == ' '; }

enum class Quote {
  kClosed,  ///< the line ends outside of a field in quotes
  kOpen,    ///< the field goes on in the next line
  kStray    ///< a quote in a field that neither ends it nor is doubled
};

/// How a line ends. @param quote  how the line before ended: kClosed or kOpen
Quote quote_at_end(std::string_view text, Quote quote) {
  for (std::size_t k = 0; k < text.size(); ++k) {
    if (text[k] != '"') continue;
    if (quote == Quote::kClosed) {
      // within a word it is a sign like others: 5" pipe
      if (k == 0 || may_separate(text[k - 1])) quote = Quote::kOpen;
      continue;
    }
    if (k + 1 < text.size() && text[k + 1] == '"') {
      ++k;
      continue;
    }
    if (k + 1 < text.size() && !may_separate(text[k + 1])) return Quote::kStray;
    quote = Quote::kClosed;
  }
  return quote;
}

}  // namespace

bool QuotedLines::next_plain(Line& line) {
  if (ahead_.empty()) return lines_.next(line);
  line_ = std::move(ahead_.front());
  ahead_.pop_front();
  line = {line_.text, line_.number, line_.terminated};
  return true;
}

/// Whether there are so many lines ahead.
bool QuotedLines::look_ahead(std::size_t count) {
  Line line;
  while (ahead_.size() < count) {
    if (!lines_.next(line)) return false;
    ahead_.push_back({std::string(line.text), line.number, line.terminated});
  }
  return true;
}

bool QuotedLines::next(Line& line) {
  if (!next_plain(line)) return false;
  if (line.text.find('"') == line.text.npos) return true;
  Quote quote = quote_at_end(line.text, Quote::kClosed);
  if (quote != Quote::kOpen) return true;
  // the reader's own memory goes with the next line
  SampleLine joined{std::string(line.text), line.number, line.terminated};
  std::size_t more = 0;
  while (quote == Quote::kOpen && more < kMostLinesOfAField && look_ahead(more + 1)) {
    const std::string& text = ahead_[more].text;
    if (joined.text.size() + text.size() >= LineReader::kLongestLine) break;
    quote = quote_at_end(text, Quote::kOpen);
    ++more;
  }
  if (quote == Quote::kClosed) {
    for (; more > 0; --more) {
      joined.text += ' ';
      joined.text += ahead_.front().text;
      joined.terminated = ahead_.front().terminated;
      ahead_.pop_front();
    }
    log_->add("quoted lines", joined.number, 1,
              "a field in quotes goes on over several lines; read as one line");
  }
  line_ = std::move(joined);
  line = {line_.text, line_.number, line_.terminated};
  return true;
}

}  // namespace dyngen::runtime
