// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <string>

#include "runtime/logs/text_layout.h"
#include "runtime/recordings/line_reader.h"

namespace dyngen::runtime {

/// Lines of a text in which a field in double quotes may go on over several lines. Such lines
/// become one, with a blank in place of each end of line. A quote that is not closed as a quote is
/// closed, before a separator or the end of a line, is a sign like others.
class QuotedLines {
 public:
  QuotedLines(ByteSource source, NoticeLog& log) : lines_(std::move(source), log), log_(&log) {}

  /// False at the end of the file. @param line  its text is valid until the next one is read
  /// @throws RecordingError  of LineReader
  bool next(Line& line);

  [[nodiscard]] double fraction_read() const { return lines_.fraction_read(); }

 private:
  bool next_plain(Line& line);
  bool look_ahead(std::size_t count);

  LineReader lines_;
  NoticeLog* log_;
  std::deque<SampleLine> ahead_;  ///< lines that were read to find the end of a field
  SampleLine line_;               ///< that was handed out
};

}  // namespace dyngen::runtime
