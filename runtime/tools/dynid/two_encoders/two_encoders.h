// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "gen/tool/progress_line.h"
#include "runtime/identification/motion_source.h"
#include "runtime/report/document.h"
#include "runtime/tools/dynid/options/options.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "runtime/wind_up/wind_up.h"

namespace dyngen::runtime {

/// What two encoders say of the joints that have them.
struct TwoEncoders {
  std::vector<WindUpResult> joints;  ///< of those with columns ql; empty: none has
  std::vector<std::string> remarks;  ///< of the recordings

  [[nodiscard]] bool any() const { return !joints.empty(); }
};

/// The load's model: a fit of the rigid robot.
struct LoadModel {
  Eigen::VectorXd beta;
  Eigen::MatrixXd covariance;  ///< 0 x 0: not known, and taken for 0
};

/// Joints (from 0) that have two encoders in one of the recordings.
std::vector<int> joints_with_two_encoders(const std::vector<MotionSource>& sources);

/// Turns of the motor for one of each joint, as a map has them; empty: not known.
std::vector<double> gears_of_map(const ToolOptions& options);

/// Hz, the highest cut-off at which loads of rigid links are used: arms swing on their gears from
/// some 10 Hz on, and a rigid model has too large a load there.
inline constexpr double kHighestLoadCutoff = 8;

/// Analyses the wind-up of each such joint. The load is the inertial torque of the model.
/// @param load  none: a weighted fit of the rigid robot at a cut-off of at most kHighestLoadCutoff
TwoEncoders two_encoders_of(const DescribedRobot& robot, const std::optional<LoadModel>& load,
                            const std::vector<MotionSource>& sources, const ToolOptions& options,
                            const WindUpRules& rules, ProgressLine& progress);

/// An elasticity that comes from the torque alone.
struct ElasticityElsewhere {
  int joint = 0;          ///< from 0
  double compliance = 0;  ///< of the finding; else the smallest that would have been found
  double deviation = 0;
  std::string where;  ///< "the finding"
  bool found = true;
};

/// Adds a sentence for each joint that has both.
void compare_elasticity(TwoEncoders& encoders, const std::vector<ElasticityElsewhere>& elsewhere);

/// One line of the answer.
struct WindUpLine {
  int joint = 0;  ///< from 0
  std::string quantity, value, interval, note;
};
std::vector<WindUpLine> wind_up_lines(const TwoEncoders& encoders);

/// The table for a terminal; empty: no joint has two encoders.
std::string two_encoders_text(const TwoEncoders& encoders);

/// The section of a page: the table, torque over wind-up of each joint, sentences.
ReportSection two_encoders_section(const TwoEncoders& encoders);

}  // namespace dyngen::runtime
