// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_fit.h"
#include "runtime/evidence/torque_noise_model.h"

namespace dyngen::runtime {

/// How much likelier a model makes recordings than another, when the noise is known from what each
/// leaves alone: twice the logarithm of the ratio of their largest likelihoods over all parameters
/// and over the coefficients of the autoregressive noise of every joint,
/// sum_j (N_j - p_j) ln(s_j^2 / s'_j^2), s_j the innovations' deviation. Of noise that an effect
/// has made slow and large it takes nothing for granted.
/// Source: Box, Jenkins, Reinsel, "Time Series Analysis", 1994, 7.1 (conditional likelihood).
class LikelihoodRatio {
 public:
  /// @param base  the smaller model's residuals; its noise decides the orders
  LikelihoodRatio(const EffectRecordings& data, const RunResiduals& base);

  /// @param larger  residuals of the model with more in it
  [[nodiscard]] double of(const RunResiduals& larger) const;

 private:
  [[nodiscard]] double innovation_squares(const RunResiduals& residuals, int joint) const;

  const EffectRecordings& data_;
  std::vector<Eigen::Index> orders_;
  Eigen::VectorXd base_, degrees_;  // (n) of each joint
};

}  // namespace dyngen::runtime
