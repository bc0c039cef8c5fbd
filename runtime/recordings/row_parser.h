// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "runtime/recordings/columns.h"
#include "runtime/recordings/cut_number.h"
#include "runtime/recordings/line_reader.h"
#include "runtime/recordings/notice_log.h"
#include "runtime/recordings/row_queue.h"

namespace dyngen::runtime {

/// Values beyond this are wild: taken for missing. Times may be larger (seconds, or even
/// nanoseconds, since 1970).
inline constexpr double kWildValue = 1e9;
inline constexpr double kWildTime = 1e19;

/// Turns lines into rows.
class RowParser {
 public:
  enum class Outcome {
    kRow,
    kTooShort,  ///< fewer fields than the header, or the last one cut within: truncated if it is
                ///< last
  };

  RowParser(const Columns& columns, NoticeLog& log);

  /// Fills the last row of `rows`. Missing and wild values become NaN, told in its info.
  /// @throws RecordingError for text that is no number, and for too many fields
  Outcome parse(const Line& line, RowQueue& rows);

  /// From now on a word of the segment column that comes again is the segment that it was.
  void segments_come_again() { segments_come_again_ = true; }

  /// What is wrong with the line that was too short.
  [[nodiscard]] const RecordingError& too_short() const { return too_short_; }

 private:
  enum class Word { kNumber, kBad, kNone, kAmbiguous };
  struct Cursor {
    const char* begin;  ///< of the line
    const char* at;
    const char* end;
  };
  [[nodiscard]] bool separates(char c) const;
  [[nodiscard]] const char* field_end(const Cursor& cursor) const;
  Word read_word(std::string_view text, std::string_view line, bool is_time, double& value);
  const char* read_value(const Line& line, const Cursor& cursor, std::size_t field, double& value,
                         RowInfo& info);
  Outcome finish(const Line& line, const Cursor& cursor, std::size_t fields, bool ended);
  void mark_bad(RowInfo& info, std::size_t field, std::size_t column, std::string_view text) const;
  void note_segment(std::string_view text);
  Outcome short_row(const Line& line, std::size_t column, const std::string& message);

  const Columns* columns_;
  NoticeLog* log_;
  char separator_;
  bool blanks_;
  std::int64_t segment_ = 0;
  bool has_segment_ = false;
  std::string segment_text_;
  bool segments_come_again_ = false;
  std::map<std::string, std::int64_t, std::less<>> segments_;
  std::string scratch_;
  RecordingError too_short_{""};
  CutNumber last_numbers_;  ///< of rows before
  bool cut_word_ = false;   ///< the last value is no number, and the file ends within it
};

}  // namespace dyngen::runtime
