// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "gen/robot_file/exact_number.h"
#include "gen/robot_file/robot_file.h"
#include "gen/robot_file/row_words.h"

namespace dyngen {

/// Values of a row, read so far.
struct ValueList {
  std::vector<FieldValue> values;
  std::optional<ExactNumber> last;  // the last value, unless it is unknown or wrong
  bool damaged = false;             // by a mistake that also upsets the count, and is reported
};

/// Values up to the end of the row, counted.
///
/// @param expected  absent if number_link is missing or wrong: then any number will do
ValueList read_values(RowWords& words, const Word& keyword, std::string_view row,
                      std::optional<int> expected, bool unknown_allowed);

/// Appends a value to the list; a wrong one as unknown, which no later check looks at.
void read_value(RowWords& words, const Word& word, std::string_view row, bool unknown_allowed,
                ValueList& list);

}  // namespace dyngen
