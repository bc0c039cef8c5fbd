// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/recordings/notice_log.h"
#include "runtime/recordings/sample_rows.h"
#include "runtime/recordings/units.h"

namespace dyngen::runtime {

/// Blanks and tabs are one where they separate.
constexpr bool is_blank(char c) { return c == ' ' || c == '\t'; }

/// How the fields of a line stand apart.
struct Separator {
  char character = ',';  ///< ' ': any number of blanks and tabs
};

/// What the header says: which field of a line goes where.
struct Columns {
  static constexpr int kIgnored = -1;
  static constexpr int kSegment = -2;

  Separator separator;
  std::vector<int> target;         ///< per field: place among the values, kIgnored or kSegment
  std::vector<std::string> names;  ///< per field, as in the file
  std::vector<ColumnQuantity> quantities;   ///< per field, where target >= 0
  std::vector<UnitConversion> conversions;  ///< per field, to SI
  bool converts = false;                    ///< a conversion changes something
  SampleLayout layout;
  std::size_t header_line = 0;
};

/// A field of a line.
struct Field {
  std::string_view text;   ///< without blanks and quotes around it
  std::size_t column = 0;  ///< of its first byte in the line, from 1
};

/// Cuts a line at its separators; quotes keep a separator inside.
std::vector<Field> split_fields(std::string_view line, Separator separator);

/// Without blanks at either end.
std::string_view trimmed(std::string_view text);

/// True if a field of this line is named "time": it is a header, or looks like one.
bool looks_like_header(std::string_view line);

/// The separator of a line: the first of semicolons, commas, tabs that it has, else blanks.
char separator_of(std::string_view line);

/// The separator of a line "sep=;", as spreadsheets write it; '\0' if it is none.
char told_separator(std::string_view line);

/// Reads the header. A name may end with a unit: "q1 [deg]", "time_ms", "tau1 (N m)".
///
/// @param separator        of the fields; '\0': seen from the header
/// @param joints           how many are expected; 0: as many as there are
/// @param torque_required  false: a trajectory, which needs no tau
/// @throws RecordingError, with line and column of the word: a column is missing, stands twice, or
///         the numbering has a gap
Columns read_header(std::string_view line, std::size_t line_number, char separator, int joints,
                    bool torque_required, NoticeLog& log);

/// Takes a row of units below the header ("s,rad,rad,Nm,Nm", with brackets or without).
///
/// @return  false if the line is none: it has a number for time, or hardly a unit
/// @throws RecordingError, with line and column: a word that is no unit of what its column
/// measures,
///         or not the unit in the column's name
bool read_unit_row(std::string_view line, std::size_t line_number, Columns& columns,
                   NoticeLog& log);

}  // namespace dyngen::runtime
