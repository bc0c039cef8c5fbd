// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"
#include "gen/robot_file/robot_file.h"
#include "gen/robot_input/robot_source.h"
#include "runtime/model/linear_model.h"
#include "runtime/tools/dynid/robot/held_numbers.h"

namespace dyngen::runtime {

/// Which parameters a robot file leaves open to estimation.
enum class OpenParameters {
  kAsWritten,   ///< what the file says: an absent row is zero
  kAbsentRows,  ///< rows that are absent are unknown too; a 0 that is written is known
  kEverything,  ///< a 0 says nothing: what physical consistency asks about
};

/// A row of 14 standard parameters of every link, one after the other: place 14 * (link - 1) + kind
/// in the order of chi.h.
using StandardParameters = Eigen::VectorXd;

/// A robot file as the estimation tools see it.
struct DescribedRobot {
  RobotFile file;
  RobotModel model;    ///< with the parameters opened as asked
  LinearModel linear;  ///< its minimal parameters and its regressor, evaluated without a compiler
  /// beta = grouping * standard parameters of the file, (nb x 14 links)
  Eigen::MatrixXd grouping;
  StandardParameters standard;  ///< numbers of the file; NaN where unknown
  /// Where the value of each base parameter goes in a file in which all others are zero: (nb)
  /// places of standard parameters.
  std::vector<Eigen::Index> places;
  /// Numbers that are kept as they are: `grouping` and the parameters of `linear` are of all
  /// others, and linear.held has their torque.
  HeldNumbers held;
  StandardParameters held_values;                    ///< their numbers, all others 0
  std::shared_ptr<const DescribedRobot> held_alone;  ///< a robot of them alone; null without any
};

/// What else is wanted of a robot.
struct DescribeOptions {
  bool gradient = false;            ///< LinearModel::regressor_gradient: some tenths of a second
  std::vector<std::string> hold{};  ///< which numbers are held: words of held_numbers()
};

/// Reads a robot in any form and writes its base regressor as a program.
/// @throws ModelError  positioned; a length or gravity component that is '*' among them
DescribedRobot describe_robot(const RobotSource& source, OpenParameters open,
                              const DescribeOptions& options = {});
/// The same of a file that was read.
DescribedRobot describe_robot(RobotFile file, OpenParameters open,
                              const DescribeOptions& options = {});

/// @throws ModelError  if the robot has no parameter that an estimate could find
void refuse_without_parameters(const DescribedRobot& robot);

}  // namespace dyngen::runtime
