// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/recordings/byte_source.h"
#include "runtime/recordings/notice_log.h"
#include "runtime/recordings/text_encoding.h"

namespace dyngen::runtime {

/// A line without its end.
struct Line {
  std::string_view text;   ///< valid until the next one is read
  std::size_t number = 0;  ///< from 1
  bool terminated = true;  ///< false: the file ends within it
};

/// Cuts bytes into lines. LF, CR LF and CR end a line; a byte order mark is skipped; UTF-16 is read
/// as UTF-8. All are noticed. Memory is bounded by the longest line allowed.
class LineReader {
 public:
  static constexpr std::size_t kLongestLine = 1 << 20;

  LineReader(ByteSource source, NoticeLog& log);

  /// False at the end of the file.
  /// @throws RecordingError for a line over 1 MB, a NUL byte, a file that cannot be read on
  bool next(Line& line);

  [[nodiscard]] double fraction_read() const;

 private:
  void refill();
  void take(Line& line, std::size_t stop, std::size_t end_size);

  TextSource source_;
  NoticeLog* log_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what is unused in buffer_
  std::size_t lf_ = 0, cr_ = 0;      ///< the next ones; end_ if there is none in the buffer
  bool at_end_ = false;
  bool cr_noticed_ = false, crlf_noticed_ = false;
  std::size_t number_ = 0;
};

}  // namespace dyngen::runtime
