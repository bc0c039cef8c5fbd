// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/effects/effect_catalogue.h"
#include "runtime/effects/effect_law.h"
#include "runtime/identification/motion_source.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// A recording whose torque is what another simulator leaves: tau - tausim.
/// @param repairs  what was repaired is appended, if not null; also where an error is thrown
/// @throws RecordingError; std::invalid_argument  if it has no columns tausim
MotionSource unexplained_motion(const std::string& path, const MotionOptions& options,
                                std::vector<Notice>* repairs = nullptr);

/// Effects that a robot file has already and that are taken off its recordings as they are written.
struct KnownEffects {
  DescribedRobot robot;  ///< with the numbers of the file
  std::vector<EffectInstance> effects;
};

/// The rows `effect` of a robot file. What a diagnosis takes for known must have numbers, and its
/// torque must be that of a joint's motion: no derivative of the rigid model, no lateness.
/// @param source  of the robot
/// @throws ModelError  positioned: for '*', for other kinds, and where an effect reads friction or
/// load that the file leaves open
KnownEffects known_effects(const RobotSource& source, const EffectCatalogue& catalogue);

/// The motion with the torque of known effects taken off.
MotionSource without_effects(const MotionSource& source, const KnownEffects& known);

}  // namespace dyngen::runtime
