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
struct HeldoutProof {
  double before = 0, after = 0;
  double change = 0;  ///< squares of the change: what an effect that is there takes away, +-
                      ///< 2 sqrt(change); one that is not adds as much
  [[nodiscard]] bool helps() const;
  /// It shows in them, and they are as an effect that is there makes them, all but one in a
  /// hundred.
  [[nodiscard]] bool agrees() const;
  /// They are worse by more than a refit's noise, where the effect does not act in them.
  [[nodiscard]] bool harms() const;
};
HeldoutProof heldout_proof(const EffectRecordings& heldout, EffectPoint before, EffectPoint after,
                           const TorqueNoiseModel& noise);

}  // namespace dyngen::runtime
