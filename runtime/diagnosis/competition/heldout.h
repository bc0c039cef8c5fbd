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

/// What held-out recordings say of one more effect: whitened squares of their residuals.
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
HeldoutProof heldout_proof(const EffectRecordings& heldout, EffectPoint before, EffectPoint after,
                           const TorqueNoiseModel& noise);

}  // namespace dyngen::runtime
