// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <vector>

namespace dyngen {

/// Where a quantity of a link is written down.
///
/// The axis frame stands on the joint's axis but does not turn with it: Rx(alpha) on the parent's
/// frame, and for joints with parallel axes one and the same frame, on the link below the first of
/// them. The link's frame is Rz(q) of it.
enum class View { kLink, kAxis };

/// Where the origin of a link's frame lies on its joint axis. It may lie anywhere on it: the base
/// parameters of a revolute link keep their form, only XZ and YZ change.
enum class Origin {
  kFile,   ///< where the file has it
  kFoot,   ///< at the height of the parent's origin, so that P has no component along the axis
  kChild,  ///< at the height of the origin of the first child whose axis is parallel
};

/// One of the algebraically equal ways to write a link's part of the recursion.
struct LinkForm {
  View inertia = View::kLink;  ///< of force and moment: U and VP, or the parameters, are turned
  View acceleration = View::kAxis;  ///< VP of a parallel axis: from the parent's VP in this view
  View force = View::kLink;         ///< in which a parallel axis hands over its force
  View moment = View::kAxis;        ///< the same for the moment across the axis
  bool euler_tensor = false;        ///< K = tr(J)/2 I - J with Kzz = 0 instead of J with YY = 0
  Origin origin = Origin::kFile;
};

/// One for each link.
using RneaForm = std::vector<LinkForm>;

}  // namespace dyngen
