// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/effect_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "gen/diagnostic/utf8.h"

namespace dyngen {
namespace {

constexpr std::string_view kBlanks = " \t\r";

bool is_blank(char c) { return kBlanks.find(c) != kBlanks.npos; }

/// The line without its comment and the blanks at its end.
std::string_view content_of(std::string_view line) {
  line = line.substr(0, std::min(line.find('#'), line.size()));
  const std::size_t last = line.find_last_not_of(kBlanks);
  return last == line.npos ? std::string_view{} : line.substr(0, last + 1);
}

EffectText piece_of(std::string_view line, std::size_t offset, int number) {
  return {std::string(line.substr(offset)), {number, 1 + character_count(line.substr(0, offset))}};
}

}  // namespace

std::vector<EffectRowText> split_effect_rows(const std::string& text, Diagnostics& diagnostics) {
  std::vector<EffectRowText> rows;
  const std::string_view all = text;
  int number = 0;
  for (std::size_t start = 0; start <= all.size();) {
    const std::size_t end = std::min(all.find('\n', start), all.size());
    const std::string_view line = content_of(all.substr(start, end - start));
    ++number;
    start = end + 1;
    if (line.empty()) continue;
    const std::size_t nul = line.find('\0');
    if (nul != line.npos) {
      diagnostics.error({number, 1 + character_count(line.substr(0, nul))}, 1,
                        "NUL byte: this is no text", "an effect file is plain text");
      return {};
    }
    const std::size_t first = line.find_first_not_of(kBlanks);
    if (first > 0) {
      if (rows.empty()) {
        diagnostics.error({number, 1 + static_cast<int>(first)}, 1,
                          "a line that begins with a blank goes on with the row above, and there "
                          "is none",
                          "begin the row in the first column");
        continue;
      }
      rows.back().pieces.push_back(piece_of(line, first, number));
      continue;
    }
    const std::size_t cut = std::min(line.find_first_of(kBlanks), line.size());
    EffectRowText row{std::string(line.substr(0, cut)), {number, 1}, {}};
    const std::size_t body = line.find_first_not_of(kBlanks, cut);
    if (body != line.npos) row.pieces.push_back(piece_of(line, body, number));
    rows.push_back(std::move(row));
  }
  return rows;
}

void EffectRowCursor::skip_blanks() {
  while (piece_ < pieces_.size()) {
    const std::string& text = pieces_[piece_].text;
    while (offset_ < text.size() && is_blank(text[offset_])) ++offset_;
    if (offset_ < text.size()) return;
    ++piece_;
    offset_ = 0;
  }
}

bool EffectRowCursor::at_end() {
  skip_blanks();
  return piece_ >= pieces_.size();
}

SourcePosition EffectRowCursor::place() {
  skip_blanks();
  if (piece_ < pieces_.size()) {
    const EffectText& piece = pieces_[piece_];
    const std::string_view before = std::string_view(piece.text).substr(0, offset_);
    return {piece.position.line, piece.position.column + character_count(before)};
  }
  if (pieces_.empty()) return end_;
  const EffectText& last = pieces_.back();
  return {last.position.line, last.position.column + character_count(last.text)};
}

std::optional<EffectText> EffectRowCursor::word() {
  if (at_end()) return std::nullopt;
  const SourcePosition position = place();
  const std::string& text = pieces_[piece_].text;
  if (text[offset_] == ':') return std::nullopt;
  const std::size_t start = offset_;
  while (offset_ < text.size() && !is_blank(text[offset_]) && text[offset_] != ':') ++offset_;
  return EffectText{text.substr(start, offset_ - start), position};
}

bool EffectRowCursor::colon() {
  if (at_end() || pieces_[piece_].text[offset_] != ':') return false;
  ++offset_;
  return true;
}

std::vector<EffectText> EffectRowCursor::until_colon() {
  std::vector<EffectText> found;
  while (!at_end()) {
    const SourcePosition position = place();
    const std::string& text = pieces_[piece_].text;
    const std::size_t end = std::min(text.find(':', offset_), text.size());
    if (end > offset_) found.push_back({text.substr(offset_, end - offset_), position});
    offset_ = end;
    if (end < text.size()) break;
  }
  return found;
}

std::vector<EffectText> EffectRowCursor::rest() {
  std::vector<EffectText> found;
  while (!at_end()) {
    const SourcePosition position = place();
    found.push_back({pieces_[piece_].text.substr(offset_), position});
    ++piece_;
    offset_ = 0;
  }
  return found;
}

std::string joined_text(const std::vector<EffectText>& pieces) {
  std::string text;
  for (const EffectText& piece : pieces) text += (text.empty() ? "" : " ") + piece.text;
  return text;
}

}  // namespace dyngen
