// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/tools/dynid/described_robot.h"

namespace dyngen::runtime {

/// The text of a robot file with other parameters: all rows of the original but those of dynamic
/// parameters, which are written anew, behind a comment.
///
/// @param standard  (14 links) places as in DescribedRobot; a row that is zero throughout is left
/// out unless the original has it
/// @param comment   lines without '#'
/// @param effects   rows that take the places of the original's rows `effect`, one for each; empty:
/// those stay
std::string identified_text(const DescribedRobot& robot, const StandardParameters& standard,
                            const std::vector<std::string>& comment,
                            const std::vector<std::string>& effects = {});

/// The standard parameters that carry base parameters; all others are zero.
StandardParameters carried(const DescribedRobot& robot, const Eigen::VectorXd& beta);

}  // namespace dyngen::runtime
