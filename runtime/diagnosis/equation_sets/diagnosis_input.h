// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// A link that a load can be mounted on: EffectRobot::tangents knows payload_XX .. payload_M of it.
struct LoadPlace {
  int joint = -1;  ///< coordinate that moves the link, from 0; -1: the last link, of any joint
  int link = 0;    ///< of the robot file, from 1; 0: the last one
};

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
  std::vector<LoadPlace> loads{};  ///< where a load is looked for that came after the reference
};

}  // namespace dyngen::runtime
