// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/recordings/recording.h"
#include "runtime/rules/steady_rules.h"

namespace dyngen::runtime {

/// A stretch of a recording.
struct Stretch {
  Eigen::Index first = 0, count = 0;  ///< rows of the recording
  double sample_time = 0;             ///< s
  double begin = 0;                   ///< s, time of the first row
  int recording = 0;                  ///< of several, from 0
  [[nodiscard]] double seconds() const { return static_cast<double>(count) * sample_time; }
};

/// A joint moves at one speed.
struct SteadyRun {
  Stretch stretch;
  double speed = 0;           ///< rad/s or m/s, with its sign
  bool alone = false;         ///< all other joints stand
  Eigen::VectorXd posture{};  ///< (n) mean positions
};

/// All joints stand.
struct HeldPose {
  Stretch stretch;
  Eigen::VectorXd q;       ///< (n) mean positions
  Eigen::VectorXi from{};  ///< (n) -1: came from below, 1: from above, 0: not known
};

/// Runs of constant speed of a joint. The speed is measured over windows, so that no filter of the
/// joint state has a part in it. The ends of a run, where it settles, are left out.
/// @param joint  from 0
std::vector<SteadyRun> find_steady_runs(const Recording& recording, Eigen::Index joint,
                                        const SteadyRules& rules);

/// Stretches in which all joints stand, and the side from which each joint came.
std::vector<HeldPose> find_held_poses(const Recording& recording, const SteadyRules& rules);

}  // namespace dyngen::runtime
