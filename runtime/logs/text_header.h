// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/logs/text_rows.h"

namespace dyngen::runtime {

/// What the lines before the first row say of its fields.
struct TextHeader {
  std::vector<std::string> names;  ///< one for each field, units taken off; empty: none was found
  std::vector<std::string> units;  ///< one for each field
  bool unnamed_end = true;         ///< the last field has no name
  std::size_t line = 0;            ///< of the names
  std::string text;                ///< that line
  /// Of files in which every signal has a time of its own: the first field of each table, and the
  /// name of that table. Empty: all fields are one table.
  std::vector<std::size_t> table_begins;
  std::vector<std::string> table_names;
};

/// Looks for names, a row of units, and for signals with times of their own: columns "Time" that
/// come again, or rows of keys as controllers write them ("Name;A1;Name;A2").
///
/// @param begin    index of the first line that may be a header
/// @param rows     the rows of data
/// @throws RecordingError if a line of names has another number of fields than the rows
TextHeader find_text_header(const std::vector<SampleLine>& sample, std::size_t begin,
                            const SampleRows& rows, NoticeLog& log);

}  // namespace dyngen::runtime
