// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "runtime/evidence/slow_noise.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// What drifts with the time since a run's beginning, the same in all runs: cosines of up to four
/// half waves in the longest of them.
struct CommonCourse {
  /// One a half wave: power is passed * density where the course is noise.
  std::vector<DifferenceLine> lines;
  /// The differences without it; low lines have back what noise loses by that.
  JointDifferences without;
};

/// Of a course that is noise: a chi-square of as many degrees as it has lines.
double chi_square(const CommonCourse& course, const JointNoise& noise);

/// Differences between neighbouring periods of one joint, of all runs: (e_t - e_(t - P)) / sqrt(2).
/// What the motion determines cancels in them.
class PeriodDifferences {
 public:
  explicit PeriodDifferences(const NoiseRules& rules = {}) : rules_(rules) {}

  /// @param e        residuals of the run, 0 where `counted` is   @param counted  1 or 0
  /// @param period   in samples; a run of less than one and a half is left out
  void add(const Eigen::VectorXd& e, const Eigen::VectorXd& counted, double period);

  /// The same of two recordings of one motion, whose noise has nothing in common.
  /// @param earlier, later  residuals, 0 where they do not count, and what counts
  /// @param lag             row k of the later one is row k + lag of the earlier one
  struct Residual {
    const Eigen::VectorXd &e, &counted;
  };
  void add_between(const Residual& earlier, const Residual& later, double lag);

  /// How many differences there are.
  [[nodiscard]] double samples() const;

  /// What all runs give together.
  [[nodiscard]] JointDifferences of_joint() const;

  /// Of three runs and more.
  [[nodiscard]] std::optional<CommonCourse> common_course() const;

 private:
  struct Run {
    Eigen::VectorXd difference, counted;
    double period = 0;  ///< infinite between recordings
  };
  [[nodiscard]] double longest() const;
  [[nodiscard]] Eigen::MatrixXd courses(const Run& run) const;
  [[nodiscard]] JointDifferences of_runs(const std::vector<Run>& runs, double restored) const;

  std::vector<Run> runs_;
  NoiseRules rules_;
};

/// noise_of_differences() of all joints. Noise of its own in each run has hardly anything in common
/// with the others: of a joint where the common course is far more than noise it is taken out.
std::vector<JointNoise> noise_of_periods(const std::vector<PeriodDifferences>& joints,
                                         const DifferenceLengths& lengths,
                                         const NoiseRules& rules = {});

}  // namespace dyngen::runtime
