// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <optional>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/kinematics/frames.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// A joint that carries a link: what a unit of its rate does to the link, in the link's frame.
///
/// Of joints with parallel axes, the one next to the link leads. The others turn the link by
/// `sign` times as much as the leader, and move its origin by `sign` times the leader's velocity
/// and `b` more: a constant vector that only turns from frame to frame.
struct JointScrew {
  int joint = 0;
  Vector3 a = {0, 0, 0};  ///< angular velocity of the link; of a leader only
  Vector3 b = {0, 0, 0};  ///< velocity of the link's origin; of the others: what comes on top
  std::optional<Vector3> b_below{};  ///< b in the parent's frame, where it is known
  int leader = 0;                    ///< itself, or the parallel joint nearer to the link
  GiNaC::ex sign = 1;                ///< of the axis along the leader's
  int center = 0;  ///< of a revolute joint: the point on its axis, see LinkScrews::centers

  [[nodiscard]] bool leads() const { return leader == joint; }
};

/// The moving joints that carry a link.
struct LinkScrews {
  std::vector<JointScrew> joints;  ///< from the base to the link's own
  /// Points where axes meet, named by the first joint there: vectors from the point to the link's
  /// origin, in the link's frame. b = a x center for all joints of a point.
  std::map<int, Vector3> centers;

  /// @return null if the joint does not carry the link
  [[nodiscard]] const JointScrew* find(int joint) const;
};

/// Writes the screws of the joints that carry each link; element 0 is the base's empty list.
///
/// One rotation about the joint's axis for each vector; chains of parallel axes turn once.
std::vector<LinkScrews> write_joint_screws(Trace& trace, const CodeModel& code,
                                           const std::vector<LinkFrame>& frames);

}  // namespace dyngen
