// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/excitation/chosen_points.h"
#include "runtime/excitation/excitation.h"
#include "runtime/excitation/multistage.h"
#include "tests/studies/study_robot.h"

namespace dyngen::test {

/// A trajectory for a robot of robots/ beside random ones within the same limits.
struct ConditionFigures {
  int parameters = 0;
  double random_median = 0, random_best = 0;  ///< of `randoms` random trajectories
  double optimised = 0, unit_columns = 0;
  runtime::LimitShares shares;  ///< at 10 kHz
  double seconds = 0;
  int evaluations = 0;
  bool found = false;
};

struct ConditionStudy {
  std::string robot;  ///< "robots/panda.robot"
  bool inertial_only = true;
  runtime::ExcitationOptions options{};
  int randoms = 20;
};
ConditionFigures condition_figures(const ConditionStudy& study);

/// The thesis's arm, its eight parameters and the limits of its Table 5.1 alone.
struct ThesisArm {
  runtime::DescribedRobot robot;
  runtime::MotionLimits limits;
  std::vector<int> parameters;  ///< P2 P3 P9 P10 P11 P13 P14 P15
};
ThesisArm thesis_arm();

/// Estimates from recordings of two motions with exact states and white torque noise.
struct EstimateComparison {
  Eigen::VectorXd random_rms;     ///< (nb) error of the estimates over the seeds, mean of motions
  Eigen::VectorXd optimised_rms;  ///< (nb)
  Eigen::VectorXd predicted;      ///< (nb) standard deviations foretold for the optimised motion
  /// The median over the parameters of random_rms / optimised_rms.
  [[nodiscard]] double median_ratio() const;
};

struct EstimateStudy {
  std::string robot;  ///< of study_robot()
  runtime::ExcitationOptions options{};
  int motions = 5;     ///< random ones
  int seeds = 30;      ///< noise for each motion
  int samples = 2000;  ///< of one period, as are recorded
};
EstimateComparison compare_estimates(const EstimateStudy& study);

}  // namespace dyngen::test
