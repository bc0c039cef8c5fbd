// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/effects/effect_recordings.h"
#include "runtime/effects/effect_signals.h"

namespace dyngen::runtime {

class HalfBandTest;

/// The data of a competition. All of them outlive it.
struct CompetitionData {
  /// Equations of the training recordings that evidence is of. Where joints rest they include the
  /// stiction intervals, in which friction torque is marked as unknown (EquationSets::evidence()).
  const EffectRecordings& evidence;
  /// Signals of `evidence`, kept for one estimate of the model at a time.
  EffectSignals& signals;
  /// The same equations away from stiction intervals. Fits and the torque noise are of these.
  const EffectRecordings& fit;
  /// The half-band test, with equations of the same recordings in half of the band.
  HalfBandTest& half_band;
  /// Held-out recordings, without the motion that the training recordings never reach.
  const EffectRecordings& heldout;
};

}  // namespace dyngen::runtime
