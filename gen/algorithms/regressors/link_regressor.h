// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <map>
#include <set>
#include <vector>

#include "gen/algorithms/kinematics/frames.h"
#include "gen/algorithms/kinematics/joint_screws.h"
#include "gen/algorithms/kinematics/kinematics.h"
#include "gen/model/chi.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Torque of one joint for each of a link's parameters XX .. M set to 1 alone.
using InertialRow = std::array<GiNaC::ex, kInertialCount>;

/// A link that moves, and the joints that carry it.
struct CarriedLink {
  int link = 0;
  std::array<bool, kInertialCount> wanted{};  ///< the others stay 0
  const LinkMotion* motion = nullptr;
  const LinkScrews* screws = nullptr;
  const LinkFrame* frame = nullptr;
  const LinkMotion* anchor_motion = nullptr;  ///< of the link below, see LinkFrame::anchor
  const LinkScrews* anchor_screws = nullptr;
  bool stands = false;            ///< the origin has no acceleration but gravity's
  std::set<int> along_gravity{};  ///< joints whose axis keeps gravity's direction
  std::set<int> about_center{};   ///< first moments act on these joints by moments about the center
  bool force_below = false;  ///< on the others by forces in the frame below, not parallel to it
};

/// Writes the rows of the joints that carry the link, by joint.
///
/// The wrench of a link with one parameter 1 has elements of U, WP, the products of W, and VP only:
///   XX: N = (WP1, W1 W3, -W1 W2)   XY: N = (-U31, U32, W1^2 - W2^2)
///   MX: F = U e1, N = e1 x VP      M: F = VP,  and cyclically;
/// a joint feels its power on the joint's screw, a . N + b . F. Where two columns together have
/// fewer products than one (XX + ZZ: N = (U32, 0, -U12)), one is got as a difference. The part of
/// ZZ that depends on velocities is W3 (a x W) z, in which rates about z do not count: the frame
/// below has it with fewer components.
std::map<int, InertialRow> write_link_regressor(Trace& trace, const CarriedLink& link);

}  // namespace dyngen
