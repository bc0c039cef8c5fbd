// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/recordings/columns.h"
#include "runtime/recordings/line_reader.h"
#include "runtime/recordings/row_parser.h"
#include "runtime/recordings/row_queue.h"
#include "runtime/recordings/sample_rows.h"

namespace dyngen::runtime {

/// What the header of a recording has to name.
struct ExpectedColumns {
  int joints = 0;  ///< 0: as many as there are
  bool torque = true;
};

/// A file's lines as rows. Blank lines, comments, a line "sep=;" and a row of units are skipped.
class RecordingRows : public SampleSource {
 public:
  /// Reads the header. @throws RecordingError
  RecordingRows(ByteSource source, const ExpectedColumns& expected, NoticeLog& log);

  [[nodiscard]] const SampleLayout& layout() const override { return columns_.layout; }
  [[nodiscard]] double fraction_read() const override { return lines_.fraction_read(); }
  [[nodiscard]] std::size_t last_place() const override { return line_.number; }
  void segments_come_again() override { parser_->segments_come_again(); }
  bool next(RowQueue& rows) override;

 private:
  bool next_line();
  void keep_comment(std::string_view text);
  Columns find_header(const ExpectedColumns& expected);
  [[noreturn]] void refuse_numbers(const ExpectedColumns& expected, char separator) const;

  NoticeLog* log_;
  LineReader lines_;
  Line line_;
  bool header_found_ = false;
  bool held_back_ = false;  ///< line_ is still to be used
  std::string comment_;     ///< the last one that looks like a header
  std::size_t comment_line_ = 0;
  std::string comment_after_;  ///< that one's next
  std::size_t comment_after_line_ = 0;
  bool units_may_come_ = false;
  Columns columns_;
  std::optional<RowParser> parser_;
  std::optional<RecordingError> last_short_;  ///< an error, unless the file ends there
  std::size_t last_short_line_ = 0;
};

}  // namespace dyngen::runtime
