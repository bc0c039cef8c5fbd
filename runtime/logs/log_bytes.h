// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace dyngen::runtime {

/// Where the bytes of a log are: in a file or in memory. Copies share them.
struct LogBytes {
  std::string path;                           ///< empty: in memory
  std::shared_ptr<const std::string> memory;  ///< null: in the file
  std::string name;                           ///< in messages
};

/// Reads a binary file from front to back, and from any place.
class BinaryReader {
 public:
  /// @throws LogError if the file cannot be opened
  explicit BinaryReader(const LogBytes& bytes);

  [[nodiscard]] std::uint64_t size() const { return size_; }
  [[nodiscard]] std::uint64_t place() const { return place_; }  ///< of the next byte, from 0
  [[nodiscard]] std::uint64_t left() const { return size_ - place_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  void seek(std::uint64_t place);

  /// @throws LogError if there are fewer bytes; `what` is what was expected
  void read(char* out, std::uint64_t count, std::string_view what);

  /// The same, as a string that replaces `out`. Memory is taken only if the bytes are there.
  void read(std::string& out, std::uint64_t count, std::string_view what);

  /// @throws LogError at the place
  [[noreturn]] void fail(std::uint64_t place, std::string_view message) const;

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::string name_;
  std::shared_ptr<const std::string> memory_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::uint64_t size_ = 0, place_ = 0;
};

/// A piece of memory that is read from its front. Errors are sentences (std::runtime_error).
class PieceReader {
 public:
  explicit PieceReader(std::string_view piece) : piece_(piece) {}

  [[nodiscard]] std::size_t left() const { return piece_.size() - place_; }
  [[nodiscard]] std::size_t place() const { return place_; }

  /// A little-endian whole number.
  template <typename Value>
  Value number();
  std::string_view bytes(std::uint64_t count);
  /// A text that begins with its length in 32 bits.
  std::string_view text();

 private:
  std::string_view piece_;
  std::size_t place_ = 0;
};

extern template std::uint8_t PieceReader::number();
extern template std::uint16_t PieceReader::number();
extern template std::uint32_t PieceReader::number();
extern template std::uint64_t PieceReader::number();

/// A path under which a library can read the bytes: the file's own, or that of a temporary copy
/// that lives as long as this.
class ReadablePath {
 public:
  /// @throws LogError if the copy cannot be written
  explicit ReadablePath(const LogBytes& bytes);
  ~ReadablePath();
  ReadablePath(const ReadablePath&) = delete;
  ReadablePath& operator=(const ReadablePath&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  bool is_copy_ = false;
};

}  // namespace dyngen::runtime
