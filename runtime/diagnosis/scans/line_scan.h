// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// Torque of a frequency of its own, whatever the motion does.
struct LineScan {
  double frequency = 0;  ///< Hz, at which most is left
  Score score;  ///< there; surrogates: the largest chi-square of noise over all frequencies
};

/// Periodograms of what the model leaves of a joint, whitened, each run with a phase of its own:
/// 2 |sum r exp(-i w t)|^2 / N added up over the runs has two degrees of freedom of each. Looked at
/// from one and a half periods in the longest run up to the equations' band; in steps of half of
/// what that run resolves. Each is divided by the mean of its neighbours, over their degrees, where
/// that exceeds 1.
/// Source: Fisher, "Tests of significance in harmonic analysis", Proc. R. Soc. A, 1929.
LineScan scan_lines(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                    bool surrogates);

}  // namespace dyngen::runtime
