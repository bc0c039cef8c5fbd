// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/diagnosis/scans/hypothesis.h"
#include "runtime/discrimination/planned_recording.h"
#include "runtime/effects/effect_recordings.h"

namespace dyngen::runtime {

/// What has to be told apart, of which robot, and how well torque is known.
struct SeparationProblem {
  LinearModel model;
  EffectRobot robot;
  Eigen::VectorXd beta;                ///< (nb) at which tau_load and friction are taken
  EffectInstance finding;              ///< with its numbers
  std::vector<EffectInstance> rivals;  ///< NaN where a parameter is looked for
  Eigen::VectorXd noise;               ///< (n) N m or N: standard deviation of one torque sample
  Eigen::VectorXd still_speed;         ///< (n) rad/s or m/s below which a joint stands
  double rate = 200;                   ///< Hz, of the recording
  double looked_at = 200;              ///< Hz at most, of the instants that are worked out
  int shape_values = 7;                ///< that are tried of each shape of a rival
  int most_shapes = 40;                ///< of a rival in all

  /// @throws std::invalid_argument  naming what was found and what was expected
  void validate() const;
};

/// How far a rival is from the finding.
struct RivalSeparation {
  EffectInstance rival;  ///< at the shapes that come nearest
  double lambda = 0;     ///< chi-square that it leaves of the finding
};

struct Separation {
  double least = 0;    ///< of all rivals
  double visible = 0;  ///< chi-square of the finding that the model alone does not absorb
  std::vector<RivalSeparation> rivals;
};

/// The T-criterion: the chi-square that remains of the finding's torque after the best joint fit of
/// the model and a rival,
///
///     min over theta, beta_b, shapes of || W theta + psi_b beta_b - psi_a ||^2.
///
/// Noise is white. Parameters of a rival that are not linear are tried over a grid.
/// Source: Atkinson and Fedorov, "The design of experiments for discriminating between two rival
/// models", Biometrika 1975.
class SeparationCriterion {
 public:
  /// @param usual  a motion that gives speeds, ranges and torques by which typical sizes and the
  ///               grids of shapes are taken
  /// @throws std::invalid_argument  if sizes do not fit, the finding cannot be worked out of a
  /// motion
  ///                                alone, or no rival can
  SeparationCriterion(SeparationProblem problem, const PlannedMotion& usual);

  /// Of one period.
  [[nodiscard]] Separation at(const PlannedMotion& motion) const;
  /// With more values of the shapes: for what is told to people.
  [[nodiscard]] Separation finely_at(const PlannedMotion& motion) const;

  [[nodiscard]] const SeparationProblem& problem() const { return problem_; }
  /// Rivals that a motion alone cannot say anything about; a sentence each.
  [[nodiscard]] const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  struct Rival {
    Hypothesis hypothesis;
    std::vector<EffectInstance> trials, fine_trials;
  };

  [[nodiscard]] EffectRecordings recording(const PlannedMotion& motion) const;
  [[nodiscard]] Separation of(const PlannedMotion& motion, bool fine) const;

  SeparationProblem problem_;
  std::vector<Rival> rivals_;
  std::vector<std::string> left_out_;
};

}  // namespace dyngen::runtime
