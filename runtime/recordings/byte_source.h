// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/recordings/gzip.h"

namespace dyngen::runtime {

/// The bytes of a recording, from a file or from memory, unpacked if they are gzip (told by their
/// first bytes, not by the file's name). Its errors are plain sentences (std::runtime_error).
class ByteSource {
 public:
  static ByteSource from_file(const std::string& path);
  static ByteSource from_text(std::string bytes);

  /// Up to `size` bytes; 0 at the end.
  std::size_t read(char* out, std::size_t size);

  /// 0..1, of the bytes on disk.
  [[nodiscard]] double fraction_read() const;

 private:
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void detect_gzip();
  void refill();

  std::unique_ptr<std::FILE, CloseFile> file_;
  std::string raw_;        ///< a piece of the file, or all of the text
  std::size_t begin_ = 0;  ///< of what is unused in raw_
  double size_ = 0;        ///< bytes on disk; 0 if unknown (a pipe)
  double consumed_ = 0;    ///< bytes taken from disk
  bool at_end_ = false;    ///< no more bytes on disk
  std::optional<Unzipper> unzipper_;
};

}  // namespace dyngen::runtime
