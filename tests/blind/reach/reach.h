// SPDX-License-Identifier: MIT
// What of the torque that was left out is in the equations that a diagnosis makes of recordings.
#pragma once

#include <vector>

#include "runtime/diagnosis/equation_sets/diagnosis_input.h"

namespace blind {

/// Squares in units of the noise, of what the model's refit leaves.
struct Reach {
  double lambda = 0;     ///< of the left-out torque, by the noise of recordings without it
  double seen = 0;       ///< the same by the noise that the diagnosis reads from its recordings
  double found = 0;      ///< of what was recorded, by one column: the left-out torque
  double repeating = 0;  ///< of `seen` in the widest band of scan_repeats() what comes back in
                         ///< every period of the motion
  double needed = 0;     ///< that one column needs where everything was asked, at its false alarms
};

/// Diagnoses recordings, and asks the equations that it ends with for what only the truth knows.
/// @param without  the fitted recordings less the torque that was left out
/// @throws TooLittleDataError  as a diagnosis
Reach reach_of(const dyngen::runtime::DiagnosisInput& input,
               std::vector<dyngen::runtime::MotionSource> without);

}  // namespace blind
