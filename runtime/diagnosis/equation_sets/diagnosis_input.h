// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// What a diagnosis looks at.
struct DiagnosisInput {
  LinearModel model;
  EffectRobot robot;
  std::vector<MotionSource> train;
  std::vector<MotionSource> heldout;    ///< may be empty: then a fifth of every recording of train
  std::vector<MotionSource> reference;  ///< of the same robot before a change; may be empty
  /// Effects that compete, each on one joint, pair or the whole robot, with `link` set. Parameters
  /// that have numbers are taken as given; others are NaN.
  std::vector<EffectInstance> hypotheses;
};

}  // namespace dyngen::runtime
