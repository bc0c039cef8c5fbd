// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/estimation/joint_noise.h"
#include "runtime/evidence/joint_columns.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Noise of the equations of every joint, and how it is known.
struct TorqueNoiseModel {
  std::vector<JointNoise> joints;
  /// (n) independent samples that the noise is known by: of the differences between periods where
  /// it is from these, else of the equations; 0: the joint has no equations, and no noise is known
  Eigen::VectorXd worth;
  bool from_periods = false;  ///< from differences between periods: free of what repeats
  /// (n) samples that are worth one, for what is as slow as the motion: density at its period, or
  /// at 0 if none repeats, over the variance.
  Eigen::VectorXd correlation_time;
  /// The periods are recordings of one motion, of which none repeats in itself.
  bool of_recordings = false;
  /// From what the largest model leaves: free of all that depends smoothly on the state.
  bool beside_largest = false;

  /// Whether it is free of what a model leaves out.
  [[nodiscard]] bool free_of_structure() const { return from_periods || beside_largest; }

  /// As intervals are told by it.
  [[nodiscard]] KnownNoise known() const;
};

/// How far apart in equations a motion repeats, of every run; 0: it does not.
std::vector<double> repeats_of(const EffectRecordings& data);

/// Residuals of a model, run by run: (equations of the run x n).
using RunResiduals = std::vector<Eigen::MatrixXd>;

/// An autoregressive process for each joint, and slow parts beside it.
///
/// Where the motion repeats, in itself or, if none does, in several recordings: of (e_t - e_(t -
/// P)) / sqrt(2), P the period, in which all that the motion determines cancels, whether a model
/// knows it or not; slow parts are read from the lines of its spectrum beside the harmonics
/// (noise_of_differences()). Elsewhere of the residual itself, which still holds what the model
/// left out: an upper bound of the noise where there is structure. What the fit took of the noise,
/// its level and its slow part, is put back: the autocovariance is the one whose noise, simulated
/// and fitted likewise, leaves what was left (indirect inference, Gourieroux, Monfort, Renault
/// 1993).
/// @param repeats   of repeats_of()
/// @param fitted    whether the model's parameters were fitted to these recordings
/// @param largest   columns beside the model, by joint: where nothing repeats, the noise is what they
///                  leave too
/// @throws std::invalid_argument  if the residual of a joint is 0
TorqueNoiseModel torque_noise_model(const EffectRecordings& data, const RunResiduals& residuals,
                                    const std::vector<double>& repeats, bool fitted,
                                    const NoiseRules& rules = {},
                                    const std::vector<JointColumns>& largest = {});

}  // namespace dyngen::runtime
