// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// Recordings whose time counts from the start of the first that they continue.
struct ClockedRecordings {
  std::vector<MotionSource> sources;  ///< in the order that they were given in
  /// "run2.csv, run3.csv continue run1.csv: ..."; empty: none continues another
  std::string sentence;
};

/// A joint that warms up goes on where the last file ended, if the time stamps say so: stamps that
/// are later than all of the file before, by no more than the longest pause. An effect's t then is
/// the time since the start of the first of these files. Files whose stamps overlap (each from 0),
/// or lie further apart (another day), keep a time of their own.
/// @param longest_pause  s
ClockedRecordings on_one_clock(std::vector<MotionSource> sources, double longest_pause);

/// s: a joint that warms up in half an hour or more keeps most of its warmth as long.
inline constexpr double kLongestPause = 600;

}  // namespace dyngen::runtime
