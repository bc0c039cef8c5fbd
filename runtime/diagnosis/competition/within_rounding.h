// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/diagnosis/scans/hypothesis.h"

namespace dyngen::runtime {

/// Whether an error of a joint's position that goes with the position is below a quarter of the
/// encoder's step: as much comes back with the motion by rounding alone, which noise of less than a
/// step does not wash out, and the best of thousands of orders fits it. No for other effects, and
/// where no step is known.
bool within_rounding(const EffectRecordings& data, const Hypothesis& hypothesis,
                     const EffectInstance& estimate);

}  // namespace dyngen::runtime
