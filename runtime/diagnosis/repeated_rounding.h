// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/diagnosis/hypothesis.h"
#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// Whether every period shows the same digits of a joint's position again: accelerations a period
/// apart differ by much less than rounding to `position_step` alone makes them differ from the true
/// ones. No scatter shows such errors, and the mean of other periods has them too. No where no
/// periods are found.
bool repeats_rounding(const MotionSource& source);

/// Whether an error of a joint's position that goes with the position is below a quarter of the
/// encoder's step: as much comes back with the motion by rounding alone, which noise of less than a
/// step does not wash out, and the best of thousands of orders fits it. No for other effects, and
/// where no step is known.
bool within_rounding(const EffectRecordings& data, const Hypothesis& hypothesis,
                     const EffectInstance& estimate);

}  // namespace dyngen::runtime
