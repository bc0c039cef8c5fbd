// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <string>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

using Vector3 = std::array<GiNaC::ex, 3>;
using Matrix3 = std::array<Vector3, 3>;

/// How a frame stands on another: Rx(alpha) Rz(angle), with sin and cos as the program has them.
struct FrameRotation {
  GiNaC::ex sin_alpha = 0, cos_alpha = 1;
  GiNaC::ex sin_angle = 0, cos_angle = 1;
};

/// Where a link's frame stands.
struct LinkFrame {
  FrameRotation rotation;  ///< in the parent
  Vector3 P;               ///< origin in the parent's frame
  /// Joints with parallel axes turn together: the link seen from the frame below the first of them,
  /// with the sum of their angles. Equal to the parent and `rotation` where the axis stands alone.
  int anchor = 0;
  FrameRotation from_anchor;
  GiNaC::ex z_sign = 1;   ///< z of the parent along the own z, if parallel: 1 or -1
  bool parallel = false;  ///< to the parent's axis
};

/// Writes sin, cos and origin of every link; element 0 is the base.
/// @param shifts  how far the origins are moved along their axes, in m; empty: not at all
std::vector<LinkFrame> write_frames(Trace& trace, const CodeModel& code,
                                    const std::vector<GiNaC::ex>& shifts = {});

/// Vector of the link's frame in the parent's (or the anchor's). @param name  of the help variable,
/// if one is needed
Vector3 to_parent(Trace& trace, const std::string& name, const FrameRotation& rotation,
                  const Vector3& v);
/// The reverse.
Vector3 to_child(Trace& trace, const std::string& name, const FrameRotation& rotation,
                 const Vector3& v);

/// The part of a rotation that is no turn about z: to the axis frame.
FrameRotation without_turn(const FrameRotation& rotation);
/// Rz(angle) v, and the reverse; the z component stays.
Vector3 turn(const FrameRotation& rotation, const Vector3& v);
Vector3 turn_back(const FrameRotation& rotation, const Vector3& v);

/// a x b
Vector3 cross(const Vector3& a, const Vector3& b);
/// All three components are written 0.
bool is_zero(const Vector3& v);

/// name1_j, name2_j, name3_j = v
Vector3 assign_vector(Trace& trace, const std::string& name, int link, const Vector3& v);

}  // namespace dyngen
