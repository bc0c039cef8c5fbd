// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "runtime/recordings/byte_source.h"

namespace dyngen::runtime {

/// Turns UTF-16 into UTF-8, piece by piece. A surrogate without its other half becomes U+FFFD.
class Utf16Decoder {
 public:
  explicit Utf16Decoder(bool big_endian) : big_endian_(big_endian) {}

  /// Appends the characters that `bytes` complete to `text`.
  void decode(std::string_view bytes, std::string& text);

 private:
  void add_unit(std::uint32_t unit, std::string& text);

  bool big_endian_;
  std::optional<unsigned char> odd_byte_;
  std::uint32_t high_ = 0;  ///< the first half of a pair; 0: none
};

/// The bytes of a text as UTF-8 or in an encoding of single bytes. UTF-16 is told by its byte order
/// mark, or by the zero bytes of its first characters.
class TextSource {
 public:
  explicit TextSource(ByteSource source) : bytes_(std::move(source)) {}

  /// Up to `size` (>= 1) bytes; 0 at the end. @throws std::runtime_error as ByteSource does
  std::size_t read(char* out, std::size_t size);

  /// Known after the first read.
  [[nodiscard]] bool is_utf16() const { return decoder_.has_value(); }
  [[nodiscard]] double fraction_read() const { return bytes_.fraction_read(); }

 private:
  void detect();

  ByteSource bytes_;
  bool begun_ = false;
  std::optional<Utf16Decoder> decoder_;
  std::string text_;       ///< waits to be read
  std::size_t begin_ = 0;  ///< of what is unused in text_
};

/// Appends a character. @param code  below 0x110000
void append_utf8(std::uint32_t code, std::string& text);

/// True if bytes are whole UTF-8 characters.
bool is_utf8(std::string_view text);

/// The text itself if it is UTF-8; else its bytes are taken for Latin-1.
std::string as_utf8(std::string_view text);

}  // namespace dyngen::runtime
