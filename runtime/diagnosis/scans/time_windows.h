// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/diagnosis/scans/hypothesis.h"

namespace dyngen::runtime {

/// Scores of a windowed hypothesis (a payload taken up, a contact) over all windows that begin and
/// end on a grid of times, in all recordings at the same time or in one of them; of one that only
/// begins, those that last to the end of each recording.
struct WindowScan {
  double begin = 0, end = 0;  ///< s, of the best window
  int recording = -1;         ///< in which alone it acts, as EffectRun::recording; -1: in all
  Score score;                ///< of the best window; surrogates: the largest over all windows
  /// Chi-square reduction per degree of freedom in other windows as long: 1 for white noise; at
  /// least 1. Noise that is slower than its model (1/f) has more, also in the best window.
  double elsewhere = 1;
  bool found = false;
};

/// Columns are whitened before a window is cut out of them: exact but for the samples at its ends.
/// @param hypothesis  scanned parameters: when it begins, and when it ends if there are two
WindowScan scan_windows(const EffectRecordings& data, EffectSignals& signals,
                        const EvidenceSystem& system, const Hypothesis& hypothesis,
                        bool surrogates);

/// Whether ScanRules::jolt_equations hold the larger part of what a torque explains: a jolt, or a
/// wild value, and nothing that lasts.
/// @param torque  one whitened column
bool is_jolt(const EvidenceSystem& system, const JointColumns& torque);

}  // namespace dyngen::runtime
