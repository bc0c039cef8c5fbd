// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/lexer.h"

#include <fmt/format.h>

#include <array>

#include "gen/diagnostic/utf8.h"
#include "gen/words/characters.h"

namespace dyngen {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

bool begins_comment(char c) { return c == '#' || c == ';'; }

bool may_stand_in_word(char c) {
  constexpr std::string_view kMarks = ".+-*/^()='";
  return is_letter(c) || is_digit(c) || kMarks.find(c) != kMarks.npos;
}

/// Walks over a text and knows line and column.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return offset_ == text_.size(); }
  [[nodiscard]] char peek() const { return text_[offset_]; }
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] SourcePosition position() const { return position_; }

  void advance() {
    if (peek() == '\n') {
      ++offset_;
      position_ = {position_.line + 1, 1};
      return;
    }
    offset_ += decode_utf8(text_, offset_).size;
    ++position_.column;
  }

 private:
  std::string_view text_;
  std::size_t offset_ = 0;
  SourcePosition position_{1, 1};
};

/// Characters that text processors and PDF files put where the format has a plain one.
struct LookAlike {
  char32_t code;
  std::string_view hint;
};

constexpr std::array<LookAlike, 23> kLookAlikes = {{
    {0x2212, "a minus sign is written '-'"},
    {0x2013, "a minus sign is written '-'"},
    {0x2014, "a minus sign is written '-'"},
    {0x2010, "a minus sign is written '-'"},
    {0x00A0, "this is a no-break space: write a plain blank"},
    {0x3000, "this is a wide space: write a plain blank"},
    {0x200B, "this is an invisible space: delete it"},
    {0xFEFF, "this is a byte order mark: delete it"},
    {0x2019, "number'link takes a plain '"},
    {0x03C0, "write pi"},
    {0x00B0, "write 90*deg for 90 degrees"},
    {0x00D7, "a product is written '*'"},
    {0x00B7, "a product is written '*'"},
    {0x00F7, "a quotient is written '/'"},
    {0x221A, "write sqrt(2)"},
    {0x00B2, "a square is written ^2"},
    {'%', "a comment begins with '#' or ';'"},
    {'"', "names stand without quotes"},
    {':', "a keyword is followed by a blank and its values, without ':'"},
    {'[', "values stand without brackets: d 0 0.5 0"},
    {'{', "values stand without brackets: d 0 0.5 0"},
    {'<', "this is a keyword format, not XML: a robot is described by rows, not by tags"},
    {',', "a comma stands between two values"},
}};

std::string_view look_alike_hint(char32_t code) {
  for (const LookAlike& entry : kLookAlikes) {
    if (entry.code == code) return entry.hint;
  }
  return "a row is a keyword and values of digits, names, + - * / ^ ( )";
}

std::size_t skip_digits(std::string_view value, std::size_t offset) {
  while (offset < value.size() && is_digit(value[offset])) ++offset;
  return offset;
}

bool begins_number(std::string_view value, std::size_t offset) {
  if (is_digit(value[offset])) return true;
  return value[offset] == '.' && offset + 1 < value.size() && is_digit(value[offset + 1]);
}

/// A number is digits with at most one point, then perhaps e, a sign and digits.
Token read_number(std::string_view value, std::size_t begin) {
  std::size_t end = skip_digits(value, begin);
  if (end < value.size() && value[end] == '.') end = skip_digits(value, end + 1);
  TokenKind kind = TokenKind::kNumber;
  if (end < value.size() && (value[end] == 'e' || value[end] == 'E')) {
    std::size_t digits = end + 1;
    if (digits < value.size() && (value[digits] == '+' || value[digits] == '-')) ++digits;
    const std::size_t after = skip_digits(value, digits);
    const bool is_exponent = after > digits;
    const bool is_name = !is_exponent && digits == end + 1 && digits < value.size() &&
                         is_letter(value[digits]);  // 2e_max: a number and a name, not an exponent
    if (!is_name) {
      end = after;
      if (!is_exponent) kind = TokenKind::kMalformed;
    }
  }
  while (end < value.size() && (is_digit(value[end]) || value[end] == '.')) {
    kind = TokenKind::kMalformed;
    ++end;
  }
  return {kind, value.substr(begin, end - begin), begin};
}

}  // namespace

std::vector<Word> split_words(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::vector<Word> words;
  Cursor cursor(text);
  if (text.starts_with(kByteOrderMark)) cursor.advance();
  bool begins_line = true;
  bool after_comma = false;
  while (!cursor.at_end()) {
    const char c = cursor.peek();
    if (c == '\n') {
      begins_line = true;
      after_comma = false;
      cursor.advance();
    } else if (is_blank(c)) {
      cursor.advance();
    } else if (begins_comment(c)) {
      while (!cursor.at_end() && cursor.peek() != '\n') cursor.advance();
    } else if (c == ',' && !begins_line && !after_comma) {
      after_comma = true;
      cursor.advance();
    } else if (c == ',') {
      words.push_back(
          {text.substr(cursor.offset(), 1), cursor.position(), 1, begins_line, after_comma, 0});
      begins_line = false;
      after_comma = true;
      cursor.advance();
    } else {
      Word word{{}, cursor.position(), 0, begins_line, after_comma, Word::kNone};
      const std::size_t begin = cursor.offset();
      while (!cursor.at_end()) {
        const char next = cursor.peek();
        if (next == '\n' || is_blank(next) || next == ',' || begins_comment(next)) break;
        if (!word.is_bad() && !may_stand_in_word(next)) word.bad = cursor.offset() - begin;
        ++word.length;
        cursor.advance();
      }
      word.text = text.substr(begin, cursor.offset() - begin);
      words.push_back(word);
      begins_line = false;
      after_comma = false;
    }
  }
  return words;
}

void report_bad_character(const Word& word, Diagnostics& diagnostics) {
  const Utf8Character character = decode_utf8(word.text, word.bad);
  SourcePosition position = word.position;
  position.column += character_count(word.text.substr(0, word.bad));
  const std::string_view bytes = word.text.substr(word.bad, character.size);
  if (!character.valid) {
    const auto byte = static_cast<unsigned char>(bytes.front());
    diagnostics.error(position, 1, fmt::format("byte 0x{:02X} is not valid UTF-8 text", byte),
                      "save the file as UTF-8 or plain ASCII");
    return;
  }
  if (bytes == ",") {
    diagnostics.error(position, 1, "no value before this ','",
                      std::string(look_alike_hint(character.code)));
    return;
  }
  const std::string found =
      is_printable(character)
          ? fmt::format("unexpected character '{}'", bytes)
          : fmt::format("unexpected character U+{:04X}", static_cast<unsigned>(character.code));
  diagnostics.error(position, 1, found, std::string(look_alike_hint(character.code)));
}

std::vector<Token> split_tokens(std::string_view value) {
  std::vector<Token> tokens;
  for (std::size_t offset = 0; offset < value.size();) {
    Token token{TokenKind::kSymbol, value.substr(offset, 1), offset};
    if (token.text == "." && !begins_number(value, offset)) {
      token.kind = TokenKind::kMalformed;
    } else if (begins_number(value, offset)) {
      token = read_number(value, offset);
    } else if (is_letter(value[offset])) {
      std::size_t end = offset;
      while (end < value.size() && (is_letter(value[end]) || is_digit(value[end]))) ++end;
      token = {TokenKind::kName, value.substr(offset, end - offset), offset};
    }
    tokens.push_back(token);
    offset += token.text.size();
  }
  tokens.push_back({TokenKind::kEnd, {}, value.size()});
  return tokens;
}

}  // namespace dyngen
