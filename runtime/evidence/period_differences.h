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
/// that they have in common, cosines of up to four half waves in the longest run, is taken out if
/// there is far more of it than chance has, and low lines get back what noise loses by that.
class PeriodDifferences {
 public:
  /// @param e        residuals of the run, 0 where `counted` is   @param counted  1 or 0
  /// @param period   in samples; a run of less than one and a half is left out
  void add(const Eigen::VectorXd& e, const Eigen::VectorXd& counted, double period);

  /// How many differences there are.
  [[nodiscard]] double samples() const;

  /// F of 4 and 4 (runs - 1) degrees where the noise of courses is alike: squares of the course
  /// that all runs have in common, over those by which they differ from it. 0 of fewer than three
  /// runs.
  [[nodiscard]] double shared() const;

  /// What all runs give together, without the course that they have in common.
  [[nodiscard]] JointDifferences of_joint();

 private:
  struct Run {
    Eigen::VectorXd difference, counted;
    double period = 0;
  };
  struct Common {
    std::vector<Eigen::MatrixXd> columns;  // of each run
    Eigen::VectorXd sizes;
    double ratio = 0;
  };
  [[nodiscard]] Common common() const;
  [[nodiscard]] double longest() const;
  [[nodiscard]] Eigen::MatrixXd courses(const Run& run) const;

  std::vector<Run> runs_;
};

}  // namespace dyngen::runtime
