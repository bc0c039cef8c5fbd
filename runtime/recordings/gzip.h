// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace dyngen::runtime {

/// True if this library was built with zlib.
bool gzip_available();

/// Unpacks a gzip stream piece by piece; several members one after another are one text.
///
/// Its errors are plain sentences (std::runtime_error); the caller knows file and line.
class Unzipper {
 public:
  Unzipper();
  ~Unzipper();
  Unzipper(Unzipper&&) noexcept;
  Unzipper& operator=(Unzipper&&) noexcept;

  /// Unpacks from the front of `packed`, which it shortens, into `out`; returns the bytes written.
  /// 0 with `packed` empty: more input is wanted.
  /// @throws std::runtime_error if the stream is corrupt, or this library has no zlib
  std::size_t unpack(std::string_view& packed, char* out, std::size_t size);

  /// False while a member is unfinished: input that ends then is truncated.
  [[nodiscard]] bool at_member_end() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes `path` as gzip. @throws std::runtime_error with the system's reason, or without zlib
class ZippedFile {
 public:
  explicit ZippedFile(const std::string& path);
  ~ZippedFile();
  ZippedFile(const ZippedFile&) = delete;
  ZippedFile& operator=(const ZippedFile&) = delete;
  void write(std::string_view text);
  void close();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace dyngen::runtime
