// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

#include "gen/bodies/moving_groups.h"

namespace dyngen {

/// What a row of a DH table is of.
enum class DhRowUse {
  kJoint,  ///< a group of bodies and the joint that moves it
  kMount,  ///< a fixed step in front of a joint that Rx Tx Rz Tz does not reach from its parent
  kTip     ///< the frame of the tip
};

/// A row of a modified DH table: T = Rx(alpha) Tx(d) Rz(theta) Tz(r), q beside theta or r.
/// Angles within kSameAngle of a multiple of pi/12 are that multiple; lengths below kSameLength are
/// 0.
struct DhRow {
  DhRowUse use = DhRowUse::kJoint;
  int parent = 0;  ///< row, from 1; 0: the base
  int group = 0;   ///< whose joint moves it (kJoint), is reached (kMount), or carries it (kTip)
  Real alpha = 0, d = 0, theta = 0, r = 0;  ///< rad, m
  Pose frame{};  ///< kJoint, kTip: of the row's frame in its group's frame
};

/// A modified DH table of a robot whose joints stand anywhere. Frame 0 is the base group's frame;
/// the joint coordinates are the description's.
///
/// z of a row's frame is the joint's axis; x is the common normal to the axis of the child with
/// most joints behind it, or to the tip's z (Khalil and Kleinfinger 1986). Another child, or a
/// first joint beside the base's x, needs two more constants, Rz(gamma) Tz(b): a mount. Where axes
/// are so nearly parallel that their common normal lies far away, a mount goes to the child's axis
/// and the joint tilts there. What is free is chosen so that few constants and inertias are not
/// zero.
std::vector<DhRow> dh_rows(const GroupedRobot& robot);

/// Mass, first moments and inertia about the origin of a frame, in its axes.
struct FrameInertia {
  Real mass = 0;
  Vector3 first_moment{};
  Matrix3 inertia{};
};
/// @param frame  in the group's frame
FrameInertia inertia_in(const MovingGroup& group, const Pose& frame);

}  // namespace dyngen
