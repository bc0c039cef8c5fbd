// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/fitted_lines.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "gen/diagnostic/utf8.h"

namespace dyngen {
namespace {

bool is_digit_at(std::string_view text, std::size_t at) {
  return at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0;
}

/// "arm.robot:4:7: error: ..." or "run.csv:17: warning: ..."
bool has_place(std::string_view line) {
  for (const std::string_view severity : {": error:", ": warning:"}) {
    const std::size_t end = line.find(severity);
    if (end == line.npos || end == 0 || !is_digit_at(line, end - 1)) continue;
    std::size_t begin = end;
    while (begin > 0 && is_digit_at(line, begin - 1)) --begin;
    if (begin > 0 && line[begin - 1] == ':') return true;
  }
  return false;
}

/// "    4 | d 0 L" or "      |     ^ declared: L": a line of a file below its message.
bool shows_file(std::string_view line) {
  const std::size_t bar = line.find(" | ");
  return bar != line.npos && bar >= 5 &&
         line.substr(0, bar).find_first_not_of(" 0123456789") == line.npos;
}

/// Columns that a text takes: colours (ESC [ ... m) take none.
std::size_t width_of(std::string_view text) {
  std::size_t width = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t colour = text.find("\033[", at);
    width += static_cast<std::size_t>(character_count(text.substr(at, colour - at)));
    if (colour == text.npos) break;
    at = std::min(text.find('m', colour), text.size() - 1) + 1;
  }
  return width;
}

/// Where what follows a break begins: a quarter of the line is left for it.
std::size_t indent_of(std::string_view line, std::size_t columns) {
  const std::size_t farthest = columns * 3 / 4;
  const std::size_t first = std::min(line.find_first_not_of(' '), line.size());
  std::size_t indent = first + 2;
  for (std::size_t i = first; i + 2 < std::min(line.size(), farthest); ++i) {
    if (line[i] == ' ' && line[i + 1] == ' ' && line[i + 2] != ' ') indent = i + 2;
  }
  return std::min(indent, farthest);
}

}  // namespace

std::string fitted_line(std::string_view line, int columns) {
  const auto width = static_cast<std::size_t>(columns);
  if (width_of(line) <= width || has_place(line) || shows_file(line)) return std::string(line);
  std::string margin(indent_of(line, width), ' ');
  if (line.starts_with('#')) margin.front() = '#';  // what follows is a comment too
  std::string result, part;
  for (std::size_t at = 0; at < line.size();) {
    // a word with the blanks before it
    const std::size_t word = std::min(line.find_first_not_of(' ', at), line.size());
    const std::size_t end = std::min(line.find(' ', word), line.size());
    const std::string_view piece = line.substr(at, end - at);
    const bool fits = width_of(part) + width_of(piece) <= width;
    if (fits || part.find_first_not_of(' ') == part.npos) {
      part += piece;
    } else {
      result += part + "\n";
      part = margin + std::string(line.substr(word, end - word));
    }
    at = end;
  }
  return result + part;
}

int terminal_columns() {
  constexpr int kUsual = 80, kNarrowest = 20;
  const char* asked = std::getenv("DYNGEN_COLUMNS");
  const int columns = asked == nullptr ? 0 : std::atoi(asked);
  return columns >= kNarrowest ? columns : kUsual;
}

FittedLines::FittedLines(std::ostream& stream, int columns)
    : stream_(stream), target_(stream.rdbuf(this)), columns_(columns) {}

FittedLines::~FittedLines() {
  if (!pending_.empty()) write(fitted_line(pending_, columns_));
  target_->pubsync();
  stream_.rdbuf(target_);
}

bool FittedLines::write(std::string_view text) {
  const auto count = static_cast<std::streamsize>(text.size());
  return target_->sputn(text.data(), count) == count;
}

bool FittedLines::add(std::string_view text) {
  bool good = true;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    pending_ += text.substr(0, end);
    if (end == text.npos) return good;
    good = write(fitted_line(pending_, columns_) + "\n") && good;
    pending_.clear();
    text.remove_prefix(end + 1);
  }
  return good;
}

FittedLines::int_type FittedLines::overflow(int_type character) {
  if (traits_type::eq_int_type(character, traits_type::eof()))
    return traits_type::not_eof(character);
  const char one = traits_type::to_char_type(character);
  return add({&one, 1}) ? character : traits_type::eof();
}

std::streamsize FittedLines::xsputn(const char* text, std::streamsize count) {
  return add({text, static_cast<std::size_t>(count)}) ? count : 0;
}

int FittedLines::sync() {
  if (pending_.find('\r') != pending_.npos) {  // a line of progress
    const bool good = write(pending_);
    pending_.clear();
    if (!good) return -1;
  }
  return target_->pubsync();
}

}  // namespace dyngen
