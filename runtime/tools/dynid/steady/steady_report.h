// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "gen/tool/progress_line.h"
#include "runtime/identification/motion_source.h"
#include "runtime/report/document.h"
#include "runtime/steady/friction_curve.h"
#include "runtime/tools/dynid/robot/described_robot.h"

namespace dyngen::runtime {

/// What runs of constant speed and held poses say of the joints that have them.
struct SteadyJoints {
  std::vector<SteadyResult> joints;  ///< empty: none has
  std::vector<std::string> remarks;  ///< of the recordings

  [[nodiscard]] bool any() const { return !joints.empty(); }
};

/// Looks at the raw torque and positions of all recordings. Runs in which other joints move are
/// left out: an error of a fitted model would be taken for friction there.
SteadyJoints steady_of(const DescribedRobot& robot, const std::vector<MotionSource>& sources,
                       const SteadyRules& rules, ProgressLine& progress);

/// The tables for a terminal; empty: no joint has runs or poses.
std::string steady_text(const SteadyJoints& steady);

/// The section of a page: the friction curve of each joint with intervals, the forms, the poses.
ReportSection steady_section(const SteadyJoints& steady);

}  // namespace dyngen::runtime
