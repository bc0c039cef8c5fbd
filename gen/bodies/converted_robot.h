// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/bodies/dh_rows.h"
#include "gen/robot_file/robot_file.h"

namespace dyngen {

/// A description of bodies as a robot file, and what became of what.
struct ConvertedRobot {
  BodyTree tree;
  GroupedRobot robot;
  std::vector<DhRow> rows;         ///< rows[j - 1] is joint j of the robot file
  std::vector<std::string> names;  ///< of the rows, identifiers, as in row `joints`
  std::string text;                ///< of the robot file
};

/// The robot file of a part of a tree; every number within 1e-12 of the description's.
///
/// @param file_name    the description's, for messages and the robot's name where it has none
/// @param diagnostics  of the description's text
/// @throws ModelError  positioned, if the part does not exist, nothing moves or there are more
///         joints than a robot file has
ConvertedRobot converted_robot(BodyTree tree, const TreePart& part, const std::string& file_name,
                               Diagnostics& diagnostics);

/// Where a value of the robot file comes from. @param column  from 0
TextPlace origin_of(const ConvertedRobot& robot, RowKey key, std::size_t column);

/// A C identifier made of any name that is no keyword of robot files: "left-arm.2" gives
/// left_arm_2.
/// @param first  what begins it where the name begins with none of its characters: "j"
std::string identifier_of(const std::string& name, const std::string& first);

}  // namespace dyngen
