// SPDX-License-Identifier: MIT
#include "runtime/recordings/text_encoding.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace dyngen::runtime {
namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;
constexpr std::size_t kPackedPiece = 1 << 16;

bool is_high_half(std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
bool is_low_half(std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

}  // namespace

void append_utf8(std::uint32_t code, std::string& text) {
  const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xC0 | (code >> 6));
    add(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    add(0xE0 | (code >> 12));
    add(0x80 | ((code >> 6) & 0x3F));
    add(0x80 | (code & 0x3F));
  } else {
    add(0xF0 | (code >> 18));
    add(0x80 | ((code >> 12) & 0x3F));
    add(0x80 | ((code >> 6) & 0x3F));
    add(0x80 | (code & 0x3F));
  }
}

void Utf16Decoder::add_unit(std::uint32_t unit, std::string& text) {
  if (high_ != 0) {
    const std::uint32_t high = high_;
    high_ = 0;
    if (is_low_half(unit)) {
      append_utf8(0x10000 + ((high - 0xD800) << 10) + (unit - 0xDC00), text);
      return;
    }
    append_utf8(kReplacement, text);
  }
  if (is_high_half(unit)) {
    high_ = unit;
  } else {
    append_utf8(is_low_half(unit) ? kReplacement : unit, text);
  }
}

void Utf16Decoder::decode(std::string_view bytes, std::string& text) {
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (!odd_byte_) {
      odd_byte_ = byte;
      continue;
    }
    const std::uint32_t first = *odd_byte_;
    odd_byte_.reset();
    add_unit(big_endian_ ? first << 8 | byte : static_cast<std::uint32_t>(byte) << 8 | first, text);
  }
}

void TextSource::detect() {
  begun_ = true;
  std::array<char, 4> head{};
  std::size_t got = 0;
  while (got < head.size()) {
    const std::size_t more = bytes_.read(head.data() + got, head.size() - got);
    if (more == 0) break;
    got += more;
  }
  const std::string_view begin(head.data(), got);
  const bool whole = got == head.size();
  const bool even_zeros = whole && head[0] == 0 && head[2] == 0 && head[1] != 0 && head[3] != 0;
  const bool odd_zeros = whole && head[1] == 0 && head[3] == 0 && head[0] != 0 && head[2] != 0;
  const bool big_mark = begin.starts_with("\xFE\xFF"), little_mark = begin.starts_with("\xFF\xFE");
  if (big_mark || even_zeros) decoder_.emplace(true);
  if (little_mark || odd_zeros) decoder_.emplace(false);
  if (decoder_) {
    decoder_->decode(begin, text_);  // a byte order mark becomes that of UTF-8
  } else {
    text_.assign(begin);
  }
}

std::size_t TextSource::read(char* out, std::size_t size) {
  if (!begun_) detect();
  for (;;) {
    if (begin_ < text_.size()) {
      const std::size_t taken = std::min(size, text_.size() - begin_);
      std::memcpy(out, text_.data() + begin_, taken);
      begin_ += taken;
      return taken;
    }
    if (!decoder_) return bytes_.read(out, size);
    std::array<char, kPackedPiece> piece;
    const std::size_t got = bytes_.read(piece.data(), piece.size());
    if (got == 0) return 0;
    text_.clear();
    begin_ = 0;
    decoder_->decode({piece.data(), got}, text_);
  }
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto lead = static_cast<unsigned char>(text[i]);
    const std::size_t length = lead < 0x80                   ? 1
                               : lead >= 0xC2 && lead < 0xE0 ? 2
                               : lead >= 0xE0 && lead < 0xF0 ? 3
                               : lead >= 0xF0 && lead < 0xF5 ? 4
                                                             : 0;
    if (length == 0 || i + length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) return false;
    }
    i += length;
  }
  return true;
}

std::string as_utf8(std::string_view text) {
  if (is_utf8(text)) return std::string(text);
  std::string converted;
  for (const char c : text) append_utf8(static_cast<unsigned char>(c), converted);
  return converted;
}

}  // namespace dyngen::runtime
