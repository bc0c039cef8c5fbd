// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/evidence/slow_noise.h"

namespace dyngen::runtime {

/// Differences between neighbouring periods of one joint, of all runs: (e_t - e_(t - P)) / sqrt(2).
///
/// What the motion determines cancels in them. What drifts with the time since a run's beginning
/// does not; where it is the same in all runs it is no noise: of three runs and more the course
/// that they have in common is taken out, cosines of up to four half waves in the longest run, and
/// low lines get back what noise loses by that.
class PeriodDifferences {
 public:
  /// @param e        residuals of the run, 0 where `counted` is   @param counted  1 or 0
  /// @param period   in samples; a run of less than one and a half is left out
  void add(const Eigen::VectorXd& e, const Eigen::VectorXd& counted, double period);

  /// How many differences there are.
  [[nodiscard]] double samples() const;

  /// What all runs give together.
  [[nodiscard]] JointDifferences of_joint();

 private:
  struct Run {
    Eigen::VectorXd difference, counted;
    double period = 0;
  };
  [[nodiscard]] double longest() const;
  [[nodiscard]] Eigen::MatrixXd courses(const Run& run) const;
  bool take_out_what_runs_share();

  std::vector<Run> runs_;
};

}  // namespace dyngen::runtime
