// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/effects/effect_fit.h"
#include "runtime/evidence/torque_noise_model.h"

namespace dyngen::runtime {

/// What a point leaves of the equations, run by run; where they do not count it is 0.
RunResiduals residuals_of(const EffectRecordings& data, const EffectPoint& point);

/// (n) sums of whitened squares of residuals: in units of the noise's variance.
Eigen::VectorXd whitened_squares(const EffectRecordings& data, const RunResiduals& residuals,
                                 const TorqueNoiseModel& noise);

/// (n) The same of recordings that were not fitted: initial states of the fitted ones are not
/// theirs.
Eigen::VectorXd heldout_squares(const EffectRecordings& heldout, EffectPoint point,
                                const TorqueNoiseModel& noise);

/// (p x p) What recordings say of the model's parameters: W'W of its equations in units of the
/// noise, the inverse of the covariance of what is fitted to them.
Eigen::MatrixXd model_information(const EffectRecordings& data, const TorqueNoiseModel& noise);

/// What held-out recordings say of one more effect: squares of their residuals, in units of what a
/// prediction may miss: noise, and the errors of the model's parameters, which others gave.
///
/// What is held out takes away `change` if the effect is there as it was estimated, within
/// 2 sqrt(change) of its own noise; the estimate's errors, which the fit made with as much noise,
/// take as many squares back as it has parameters, twice, in the ratio of both recordings'
/// information, and are uncertain themselves. What is no noise with it and without it, a stop that
/// was not seen or a jolt, says nothing and is left out.
struct HeldoutProof {
  double before = 0, after = 0;
  double change = 0;      ///< squares of what the effect changes; one that is not there adds them
  double parameters = 0;  ///< that were estimated
  double fitted = 0;      ///< squares that it explains of the recordings that it was fitted to
  [[nodiscard]] bool helps() const;
  /// What the effect changes in them is enough to tell.
  [[nodiscard]] bool informs() const;
  /// It shows in them, and they are as an effect that is there makes them, all but one in a
  /// hundred.
  [[nodiscard]] bool agrees() const;
  /// They are worse by more than a refit's noise, where the effect does not act in them.
  [[nodiscard]] bool harms() const;
};
/// @param known  model_information() of the recordings that were fitted; empty: the model has no
///               parameters to be fitted
HeldoutProof heldout_proof(const EffectRecordings& heldout, EffectPoint before, EffectPoint after,
                           const TorqueNoiseModel& noise, const Eigen::MatrixXd& known);

}  // namespace dyngen::runtime
