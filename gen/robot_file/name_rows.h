// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gen/robot_file/robot_file.h"
#include "gen/robot_file/row_words.h"

namespace dyngen {

/// The one name that a row has, or null if it is missing or wrong, which is reported.
/// @param keyword  that began the row     @param row  its spelling, for messages
const Word* read_one_name(RowWords& words, const Word& keyword, std::string_view row);

/// Reports what stands behind the one word of a row.
void check_nothing_follows(RowWords& words, std::string_view row);

/// Row `dh`; absent if it names no convention, which is reported.
std::optional<DhConvention> read_dh_row(RowWords& words, const Word& keyword);

/// Row `parameters`; absent if it names no meaning, which is reported.
std::optional<ParameterMeaning> read_parameters_row(RowWords& words, const Word& keyword);

/// Row `let`, whose name is declared.
void read_let_row(RowWords& words, const Word& keyword);

/// Row `joints`: the names as written, also those that are reported.
/// @param joint_count  absent if number_link is missing or wrong: then any number will do
std::vector<std::string> read_joints_row(RowWords& words, const Word& keyword,
                                         std::optional<int> joint_count);

}  // namespace dyngen
