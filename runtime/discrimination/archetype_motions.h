// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/diagnosis/names/archetypes.h"
#include "runtime/discrimination/planned_recording.h"
#include "runtime/excitation/motion_limits.h"

namespace dyngen::runtime {

/// An archetype on a robot: motions that are free in some numbers.
///
/// All of them are within the limits of position, speed and acceleration, begin and end at rest in
/// the same place, and move only the joints that matter.
struct ArchetypeMotion {
  Archetype archetype = Archetype::kAllJoints;
  int joint = -1;         ///< that is looked at; -1: all
  Eigen::VectorXd start;  ///< (d) the numbers to begin with, 0 .. 1
  /// @param x  (d) each in 0 .. 1: amplitudes, speeds, accelerations, postures, Fourier
  /// coefficients
  std::function<PlannedMotion(const Eigen::VectorXd& x, const MotionLimits& limits)> motion;
  /// The same with less of amplitude, speed and acceleration; postures stay.
  std::function<Eigen::VectorXd(Eigen::VectorXd x, double factor)> smaller;
};

/// Motions of one period to begin with, some of each archetype.
/// @param limits    positions, speeds and accelerations are held by the motions; torque and the box
///                  are for the caller to look at
/// @param joint     the joint of the finding, from 0; -1: of the whole robot, so that each joint in
///                  turn is tried
/// @param duration  s, of one period
/// @param seed      of postures and of Fourier coefficients
std::vector<ArchetypeMotion> archetype_motions(const MotionLimits& limits, int joint,
                                               double duration, std::uint64_t seed);

}  // namespace dyngen::runtime
