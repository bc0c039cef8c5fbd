// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/absorption.h"
#include "runtime/effects/effect_constraints.h"
#include "runtime/effects/effect_recordings.h"
#include "runtime/effects/effect_signals.h"
#include "runtime/effects/equation_stack.h"

namespace dyngen::test {

/// How strongly recordings show a torque, once the model is refitted: with the truth at hand.
class StrengthMeter {
 public:
  /// @param data   of the machine without effects; one run a recording. Must outlive it
  /// @param beta   of the truth
  /// @param noise  of the truth
  StrengthMeter(const runtime::EffectRecordings& data, const Eigen::VectorXd& beta,
                const runtime::AtlasNoise& noise);

  /// What a refit leaves, whitened, of a torque that is added to the recordings.
  /// @param torque  of each recording, (N x n) at its samples
  /// @param from    time of the first sample of each, s
  [[nodiscard]] Eigen::VectorXd left_of(const std::vector<Eigen::MatrixXd>& torque) const;
  /// The same before a refit.
  [[nodiscard]] Eigen::VectorXd whitened(const std::vector<Eigen::MatrixXd>& torque) const;

  /// Part of a left torque's squares that an effect of another form can take up, its linear
  /// parameters free and its shapes at the best of a few: 0 .. 1.
  double likeness(const Eigen::VectorXd& left, const runtime::EffectInstance& effect);

 private:
  const runtime::EffectRecordings& data_;
  Eigen::VectorXd beta_;
  runtime::EffectSignals signals_;
  runtime::ScaleTable scales_;
  runtime::EquationStack stack_;
  runtime::Projection projection_;
};

}  // namespace dyngen::test
