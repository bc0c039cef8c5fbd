// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/row_words.h"

#include <fmt/format.h>

#include <utility>

#include "gen/robot_file/keywords.h"
#include "gen/words/spelling.h"

namespace dyngen {

RowWords::RowWords(std::string_view text, Diagnostics& diagnostics)
    : diagnostics_(diagnostics), words_(split_words(text)) {
  // to tell a name declared too late from one never declared
  for (std::size_t i = 0; i + 1 < words_.size(); ++i) {
    const Keyword* keyword = find_keyword(words_[i].text);
    const Word& name = words_[i + 1];
    if (keyword == nullptr || keyword->statement != Statement::kLet) continue;
    if (!name.begins_line && is_identifier(name.text)) names_.announce(name.text, name.position);
  }
}

const Word* RowWords::after_next() const {
  const bool stands = next_ + 1 < words_.size() && !words_[next_ + 1].begins_line;
  return stands ? &words_[next_ + 1] : nullptr;
}

bool RowWords::at_keyword() const { return has_next() && find_keyword(peek().text) != nullptr; }

const Word& RowWords::take() {
  names_.mark_used(peek().text);
  return words_[next_++];
}

void RowWords::skip_line() {
  while (!at_line_end()) take();
}

void RowWords::error(const Word& word, const std::string& message, const std::string& hint) {
  diagnostics_.error(word.position, word.length, message, hint);
}

bool starts_like_value(std::string_view word) {
  constexpr std::string_view kStarts = "0123456789.+-(*";
  return kStarts.find(word.front()) != kStarts.npos;
}

std::string plural(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

SourcePosition end_of(const Word& word) {
  return {word.position.line, word.position.column + word.length};
}

}  // namespace dyngen
