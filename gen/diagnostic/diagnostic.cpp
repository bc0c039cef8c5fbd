// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/diagnostic/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

#include "gen/diagnostic/utf8.h"

namespace dyngen {

namespace {

constexpr int kMaxEchoedCharacters = 100;  // longer lines are shown around the caret only
constexpr int kCharactersBeforeCaret = 60;
constexpr int kMaxPrintableCharacters = 60;
constexpr std::string_view kEllipsis = "...";

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = text.find('\n', begin);
    std::string_view line = text.substr(begin, end == text.npos ? text.npos : end - begin);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    if (end == text.npos) return lines;
    begin = end + 1;
  }
}

/// The line of the text and, below it, the caret, both beginning at the same terminal column.
struct Excerpt {
  std::string echo;
  std::string underline;
};

Excerpt make_excerpt(std::string_view line, int column, int length) {
  const int count = character_count(line);
  const int caret = std::clamp(column - 1, 0, count);
  int begin = 0;
  int end = count;
  if (count > kMaxEchoedCharacters) {
    begin = std::clamp(caret - kCharactersBeforeCaret, 0, count - kMaxEchoedCharacters);
    end = begin + kMaxEchoedCharacters;
  }
  Excerpt excerpt;
  if (begin > 0) excerpt.echo += kEllipsis;
  excerpt.underline.append(excerpt.echo.size(), ' ');
  std::size_t offset = 0;
  for (int i = 0; i < end; ++i) {
    const Utf8Character character = decode_utf8(line, offset);
    if (i >= begin) {
      const bool is_tab = character.code == '\t';
      const bool is_shown = is_tab || is_printable(character);
      excerpt.echo += is_shown ? line.substr(offset, character.size) : "?";
      // A tab is repeated below itself: it then ends at the same place, however wide the terminal
      // makes it.
      if (i < caret) excerpt.underline += is_tab ? '\t' : ' ';
    }
    offset += character.size;
  }
  if (end < count) excerpt.echo += kEllipsis;
  const int underlined = std::clamp(length, 1, std::max(1, end - caret));
  excerpt.underline += '^';
  excerpt.underline.append(static_cast<std::size_t>(underlined - 1), '~');
  return excerpt;
}

std::string cleaned(std::string_view piece, int max_characters) {
  std::string out;
  int count = 0;
  for (std::size_t offset = 0; offset < piece.size(); ++count) {
    if (count == max_characters) return out.append(kEllipsis);
    const Utf8Character character = decode_utf8(piece, offset);
    if (is_printable(character)) {
      out += piece.substr(offset, character.size);
    } else {
      out += '?';
    }
    offset += character.size;
  }
  return out;
}

/// What a file holds may stand in a message: no byte of it ends the line or moves the cursor.
std::string one_line(std::string_view text) {
  return cleaned(text, std::numeric_limits<int>::max());
}

std::string_view spelled(Severity severity) {
  return severity == Severity::kError ? "error" : "warning";
}

std::string left_out(std::string_view file_name, std::size_t count, std::string_view what) {
  return fmt::format("{}: {} more {}{} left out\n", file_name, count, what, count == 1 ? "" : "s");
}

}  // namespace

Diagnostics::Diagnostics(std::string file_name, std::string text)
    : file_name_(std::move(file_name)), text_(std::move(text)) {}

void Diagnostics::error(SourcePosition position, int length, const std::string& message,
                        const std::string& hint) {
  if (++error_count_ > kMaxErrors) return;
  all_.push_back({Severity::kError, position, length, one_line(message), one_line(hint)});
}

void Diagnostics::warning(SourcePosition position, int length, const std::string& message,
                          const std::string& hint) {
  if (++warning_count_ > kMaxErrors) return;
  all_.push_back({Severity::kWarning, position, length, one_line(message), one_line(hint)});
}

std::string Diagnostics::render() const {
  std::vector<Diagnostic> sorted = all_;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::pair(a.position.line, a.position.column) <
           std::pair(b.position.line, b.position.column);
  });
  const std::vector<std::string_view> lines = split_lines(text_);
  // A file name is shown whole: tools find the file by it.
  const std::string name = one_line(file_name_);
  std::string out;
  auto to = std::back_inserter(out);
  for (const Diagnostic& d : sorted) {
    const bool has_line =
        d.position.line >= 1 && static_cast<std::size_t>(d.position.line) <= lines.size();
    if (!has_line) {
      fmt::format_to(to, "{}: {}: {}\n", name, spelled(d.severity), d.message);
      if (!d.hint.empty()) fmt::format_to(to, "{:>5} | {}\n", "", d.hint);
      continue;
    }
    const Excerpt excerpt = make_excerpt(lines[static_cast<std::size_t>(d.position.line - 1)],
                                         d.position.column, d.length);
    fmt::format_to(to, "{}:{}:{}: {}: {}\n", name, d.position.line, d.position.column,
                   spelled(d.severity), d.message);
    fmt::format_to(to, "{:>5} | {}\n", d.position.line, excerpt.echo);
    fmt::format_to(to, "{:>5} | {}{}{}\n", "", excerpt.underline, d.hint.empty() ? "" : " ",
                   d.hint);
  }
  if (error_count_ > kMaxErrors) out += left_out(name, error_count_ - kMaxErrors, "error");
  if (warning_count_ > kMaxErrors) out += left_out(name, warning_count_ - kMaxErrors, "warning");
  return out;
}

std::string printable(std::string_view piece) { return cleaned(piece, kMaxPrintableCharacters); }

}  // namespace dyngen
