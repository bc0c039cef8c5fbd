// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/diagnostic/utf8.h"

namespace dyngen {

namespace {

constexpr Utf8Character kInvalid{0, 1, false};

struct Lead {
  std::size_t size;
  char32_t bits;
  char32_t smallest;  // a smaller code in this many bytes is overlong
};

Lead read_lead(unsigned char byte) {
  if (byte < 0x80) return {1, byte, 0};
  if (byte >= 0xC0 && byte < 0xE0) return {2, byte & 0x1FU, 0x80};
  if (byte >= 0xE0 && byte < 0xF0) return {3, byte & 0x0FU, 0x800};
  if (byte >= 0xF0 && byte < 0xF8) return {4, byte & 0x07U, 0x10000};
  return {0, 0, 0};
}

}  // namespace

Utf8Character decode_utf8(std::string_view text, std::size_t offset) {
  const Lead lead = read_lead(static_cast<unsigned char>(text[offset]));
  if (lead.size == 0 || offset + lead.size > text.size()) return kInvalid;
  char32_t code = lead.bits;
  for (std::size_t i = 1; i < lead.size; ++i) {
    const auto byte = static_cast<unsigned char>(text[offset + i]);
    if ((byte & 0xC0U) != 0x80U) return kInvalid;
    code = (code << 6U) | (byte & 0x3FU);
  }
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < lead.smallest || surrogate || code > 0x10FFFF) return kInvalid;
  return {code, lead.size, true};
}

int character_count(std::string_view text) {
  int count = 0;
  for (std::size_t i = 0; i < text.size(); i += decode_utf8(text, i).size) ++count;
  return count;
}

bool is_printable(const Utf8Character& character) {
  const char32_t code = character.code;
  if (!character.valid || code < 0x20 || (code >= 0x7F && code <= 0xA0)) return false;
  const bool invisible = code == 0xAD || (code >= 0x200B && code <= 0x200F) ||
                         (code >= 0x2028 && code <= 0x202F) || (code >= 0x2060 && code <= 0x206F) ||
                         code == 0xFEFF;
  return !invisible;
}

}  // namespace dyngen
