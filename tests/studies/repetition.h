// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/identification/fit.h"
#include "runtime/identification/motion_rows.h"
#include "runtime/identification/motion_source.h"
#include "tests/studies/study_robot.h"

namespace dyngen::test {

/// Which motion is made, and how often.
struct MotionPlan {
  bool repeats = true;  ///< two equal periods of 10 s; else a motion that does not repeat
  double amplitude = 1;
};

/// The motion of one repetition. Different seeds, different motions.
FourierMotion study_motion(const StudyRobot& robot, const MotionPlan& plan, unsigned seed);

/// Equations of a recording, kept in memory so that no method makes them again.
struct StudyData {
  runtime::FitData data;
  runtime::MotionSource source;
};

/// @param run        its `measured`, or its `truth` with StateMethod::kRecorded
/// @param reference  for instruments; null: there are none
StudyData study_data(const StudyRobot& robot, const runtime::Recording& recording,
                     const FourierMotion* reference, const runtime::MotionOptions& options = {},
                     const runtime::RowOptions& rows = {});

/// A method's estimate against the truth.
struct MethodScore {
  runtime::FitMethod method = runtime::FitMethod::kLs;
  double torque_error = 0;     ///< ||Y (beta - truth)|| / ||Y truth|| over a held-out motion
  std::vector<double> errors;  ///< |beta - truth| in stated standard deviations
  std::vector<double> textbook_errors;       ///< the same in those of the textbook
  double covered = 0, textbook_covered = 0;  ///< part of the parameters; NaN: nothing stated
  double parameter_error = 0;                ///< ||beta - truth|| / ||truth||, columns of unit norm
  double seconds = 0;
  double condition = 0;
  double p_value = -1;  ///< of the test that iv makes
};

/// A clean motion that no method has seen.
struct HeldoutMotion {
  Eigen::MatrixXd Y;    ///< (N n x nb)
  Eigen::VectorXd tau;  ///< (N n) of the truth
  [[nodiscard]] double error(const Eigen::VectorXd& beta) const {
    return (Y * beta - tau).norm() / tau.norm();
  }
};
HeldoutMotion heldout_motion(const StudyRobot& robot);

MethodScore score(const StudyRobot& robot, const runtime::TorqueFactor& equations,
                  const HeldoutMotion& heldout, const runtime::MethodFit& fit);

/// All methods asked for, each timed.
std::vector<MethodScore> run_methods(const StudyRobot& robot, const StudyData& data,
                                     const HeldoutMotion& heldout,
                                     const std::vector<runtime::FitMethod>& methods,
                                     const runtime::FitOptions& options);

/// The truth with every value off by a random part of it. @param part  standard deviation
Eigen::VectorXd prior_of(const StudyRobot& robot, double part, unsigned seed);

}  // namespace dyngen::test
