// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/discrimination/planned_recording.h"
#include "runtime/excitation/motion_limits.h"

namespace dyngen::runtime {

/// Motions whose mean torque is the evidence (docs/explanation/steady_speeds.md).
enum class ProgrammeKind {
  kSpeeds,  ///< each joint in turn at constant speeds from slow to fast, both ways
  kPoses,   ///< all joints to held poses, each reached from below and from above
  kSweeps   ///< each joint in turn slowly over its range and back
};

struct ProgrammeOptions {
  ProgrammeKind kind = ProgrammeKind::kSpeeds;
  double hold = 0;          ///< s: of a run, in a pose, of a sweep one way; 0: 6, 2, 30
  int count = 0;            ///< speeds, poses, sweeps there and back; 0: 10, 20, 2
  std::vector<int> joints;  ///< that move, from 0; empty: all
  Eigen::VectorXd posture;  ///< (n) of the joints that stand; empty: the middle of their ranges

  [[nodiscard]] double hold_seconds() const;
  [[nodiscard]] int step_count() const;
  /// @throws std::invalid_argument  naming what was found and what was expected
  void validate(const MotionLimits& limits) const;
};

/// A run, a pose or a sweep.
struct ProgrammeStep {
  int joint = -1;                 ///< from 0; -1: all
  double begin = 0, seconds = 0;  ///< s; without ramps
  double speed = 0;               ///< rad/s or m/s, with its sign; 0: a pose
  double from = 0, to = 0;        ///< rad or m, of the whole stroke
  int side = 0;                   ///< of a pose: -1: reached from below, 1: from above
};

struct Programme {
  PlannedMotion motion;
  std::vector<ProgrammeStep> steps;
};

/// Strokes from rest to rest whose speed is a trapezoid with round corners (JointPath): limits of
/// position, speed and acceleration hold by the way they are made.
/// @param limits  with finite speeds
/// @throws std::invalid_argument  of the options
Programme steady_programme(const MotionLimits& limits, const ProgrammeOptions& options);

}  // namespace dyngen::runtime
