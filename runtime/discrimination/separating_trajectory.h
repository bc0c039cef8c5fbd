// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/diagnosis/names/archetypes.h"
#include "runtime/discrimination/separation.h"
#include "runtime/excitation/motion_limits.h"

namespace dyngen::runtime {

struct SeparatingOptions {
  double duration = 10;       ///< s, one period
  std::uint64_t seed = 1;     ///< of random motions, postures and coefficients
  double seconds = 60;        ///< at most
  int evaluations = 0;        ///< at most; above 0 the clock ends nothing
  double check_rate = 10000;  ///< Hz, at which limits must be kept
  /// Told now and then what is being done.
  std::function<void(const std::string& what, std::size_t place, std::size_t all)> progress{};

  /// @throws std::invalid_argument  naming what was found and what was expected
  void validate() const;
};

/// The best motion of an archetype before it was refined.
struct ArchetypeScore {
  Archetype archetype = Archetype::kAllJoints;
  int joint = -1;    ///< that moves; -1: all
  double least = 0;  ///< of Separation
};

/// A motion that tells a finding from its rivals.
struct SeparatingTrajectory {
  bool found = false;  ///< false: no motion keeps the limits, or none separates; see message
  std::string message;
  PlannedMotion motion;
  Archetype archetype = Archetype::kAllJoints;
  int joint = -1;
  Separation separation;  ///< of one period, shapes tried finely
  /// Of the random motion in the middle of five; without rivals if none keeps the limits.
  Separation random;
  std::vector<ArchetypeScore> scores;  ///< falling
  std::vector<std::string> left_out;   ///< rivals that a motion alone says nothing about
  LimitShares shares;                  ///< at the check rate
  std::uint64_t random_seed = 0;       ///< of `random`
  int evaluations = 0;
};

/// Looks for the motion on which the finding of a problem is farthest from its nearest rival,
/// within limits: the best of the archetypes, whose free numbers are then refined (NLopt's Subplex,
/// Rowan 1990: the criterion has no derivative where rivals are equally near). Limits are held at
/// the check rate.
/// @throws std::invalid_argument  if options, limits or the problem do not fit the model
SeparatingTrajectory separate(const SeparationProblem& problem, const MotionLimits& limits,
                              const SeparatingOptions& options);

/// The random motion that an exciting trajectory would begin with, all joints at once.
/// @return a motion without duration if none keeps the limits
PlannedMotion random_motion(const LinearModel& model, const MotionLimits& limits, double duration,
                            std::uint64_t seed);

}  // namespace dyngen::runtime
