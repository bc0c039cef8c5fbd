// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gen/tool/output_files.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// What stands in a robot file with other parameters besides them.
struct IdentifiedRows {
  std::vector<std::string> comment;  ///< lines without '#'
  /// Rows that take the places of the original's rows `effect`, one for each; empty: those stay.
  std::vector<std::string> effects{};
  std::vector<std::string> added{};  ///< rows behind the parameters
  /// Of the numbers; kBase is said in a row, which exempts them from checks of single bodies.
  ParameterMeaning meaning = ParameterMeaning::kBase;
};

/// The text of a robot file with other parameters: all rows of the original but those of dynamic
/// parameters, which are written anew, behind a comment. Numbers read back as they are.
///
/// @param standard  (14 links) places as in DescribedRobot; a row that is zero throughout is left
/// out unless the original has it
std::string identified_text(const DescribedRobot& robot, const StandardParameters& standard,
                            const IdentifiedRows& rows);

/// The text of a robot file with further rows at its end; nothing else changes.
std::string text_with_rows(const RobotFile& file, const std::vector<std::string>& rows);

/// Writes robot files, each of which is read once more before.
/// @throws std::logic_error  naming the file that dyngen would not read; then nothing is written
/// @throws OutputError
void write_robot_files(const std::vector<OutputFile>& files);

/// The standard parameters that carry base parameters; held numbers are kept, all others are zero.
StandardParameters carried(const DescribedRobot& robot, const Eigen::VectorXd& beta);

/// Rotor inertias that the file says and that base parameters have joined with the links'.
/// @return  places of standard parameters
std::vector<Eigen::Index> joined_rotors(const DescribedRobot& robot);

/// The same beside the joined rotors of the file, which keep their inertia, so that the load of a
/// joint, which effects read, is what it was to the fit.
StandardParameters carried_beside_rotors(const DescribedRobot& robot, const Eigen::VectorXd& beta);

/// Standard parameters whose base parameters are these: those nearest to the file's where it has
/// numbers for all of them, else carried_beside_rotors(). Joined rotors keep the file's inertia.
StandardParameters nearest_standard(const DescribedRobot& robot, const Eigen::VectorXd& beta);

}  // namespace dyngen::runtime
