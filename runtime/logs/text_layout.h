// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/logs/raw_log.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {

/// A line of the beginning of a file, kept.
struct SampleLine {
  std::string text;
  std::size_t number = 0;  ///< from 1
  bool terminated = true;
};

enum class FieldKind {
  kNumber,
  kWhole,      ///< whole numbers too large for a double: counted from the first one
  kNanoCount,  ///< decimals too long for a double: counted in 1e-9 from the first one
  kInstant,    ///< dates and times: seconds from the first one
  kTimeOfDay,  ///< the same without a date
  kText,       ///< words: no values
};

/// Where the values of a field go, and what they are.
struct TextField {
  std::size_t table = 0, column = 0;
  FieldKind kind = FieldKind::kNumber;
  std::string word{};  ///< of kText: that of all rows of the sample; empty: they differ
};

/// What stands where in a text of rows.
struct TextLayout {
  char separator = ',';  ///< ' ': any number of blanks and tabs
  char decimal = '.';
  std::string decimal_word;       ///< a word that shows the decimal sign; empty: none does
  std::size_t first_row = 0;      ///< index of the first row of data among the lines of the sample
  std::size_t header_line = 0;    ///< 0: none
  std::string header;             ///< as it is written, to know it if it comes again
  std::vector<TextField> fields;  ///< one for each field of a row
  std::vector<LogTable> tables;   ///< more than one: each signal has a time of its own
};

/// Finds out how a text is laid out.
///
/// @param sample   the lines at its beginning, without blank ones; all of them if `whole`
/// @throws RecordingError, with line and column, if no rows of numbers are found, or names and rows
/// do not fit
TextLayout find_layout(const std::vector<SampleLine>& sample, bool whole,
                       const LogTextSettings& settings, NoticeLog& log);

/// True for a line that only comments: it begins with '#', '//', '*' or '%' (but not "%time").
bool is_comment(std::string_view line);

}  // namespace dyngen::runtime
