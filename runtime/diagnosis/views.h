// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/diagnosis.h"
#include "runtime/diagnosis/division.h"
#include "runtime/diagnosis/witness.h"

namespace dyngen::runtime {

/// What of recordings is looked at.
struct ViewOptions {
  RowOptions rows;
  /// Joints, from 0, that rest for an instant where they turn, and have no equations there.
  std::vector<int> resting;
};

/// The view of recordings whose joints, as was found, rest. Where friction holds a joint it has any
/// torque up to its own: equations there are left out. What lets go jolts the arm, and of jolts a
/// slow joint state is not the state: it passes a filter that is as quick as can be, and the
/// equations a much slower one, so that what noise is in it does not reach them.
/// @param train  recordings that the model is fitted to
ViewOptions beside_rests(const ViewOptions& options, const std::vector<MotionSource>& train,
                         std::vector<int> resting);

/// The smallest part of a joint's equations that count.
double least_counted(const EffectRecordings& data);

/// Equations of recordings, without those of joints that stand still.
EffectRecordings equations_of(const DiagnosisInput& input, const std::vector<MotionSource>& sources,
                              const ViewOptions& options);

/// The recordings of a diagnosis as its competition reads them.
struct Views {
  EffectRecordings train, heldout;
  EffectRecordings proof;  ///< what is held out, where the fitted recordings have been
  /// The fitted ones again, as witnesses: in half the band, and at the mean motion of the other
  /// periods.
  EffectRecordings slow, repeated;

  /// All must outlive them.
  [[nodiscard]] Witnesses witnesses() const;
};
Views views_of(const DiagnosisInput& input, const Division& parts, const ViewOptions& options);

}  // namespace dyngen::runtime
