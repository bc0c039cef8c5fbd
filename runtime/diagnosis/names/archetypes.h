// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// Kinds of motion that tell effects apart. In this order they are asked for in words: what splits
/// most comes first.
enum class Archetype {
  kNestedReversals,  ///< reversals within reversals, at three speeds
  kSlowBothWays,     ///< constant speeds both ways, the slowest first
  kTwoLoads,         ///< the same way in two postures of the other joints
  kColdAndWarm,      ///< the same motion before and after a fast one
  kSmallAndFast,     ///< small sines of high frequency
  kTwoSpeeds,        ///< the same way slowly and fast
  kSlowSweep,        ///< one joint over its whole range
  kAllJoints         ///< sines of all joints, as of an exciting trajectory
};

/// What people read of an archetype.
struct ArchetypeWords {
  Archetype archetype = Archetype::kAllJoints;
  std::string motion;
  /// For its families: how to record it, where running it once is not all; else empty.
  std::string instruction;
  std::set<std::string> families;  ///< that it is the first choice for
};

/// All of them, in the order of Archetype.
const std::vector<ArchetypeWords>& archetypes();

const ArchetypeWords& words_of(Archetype archetype);

/// The first that is made for one of the families; the slow sweep where none is.
const ArchetypeWords& archetype_for(const std::vector<std::string>& families);

}  // namespace dyngen::runtime
