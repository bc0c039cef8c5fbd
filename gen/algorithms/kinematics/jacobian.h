// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes the geometric Jacobian of the file's frame of a link as the output "J": 6 x n, row-major;
/// rows vx vy vz wx wy wz: velocity of the frame's origin (m/s) and angular velocity (rad/s), both
/// in the axes of frame 0. Columns of joints that do not carry the link are zero.
///
/// A revolute joint gives z and z x (origin - a point of the axis). Near the base the cross product
/// is taken in the axes of the joint's anchor, where z is known, and then turned; near the tip it
/// is taken in frame 0. Where one ends and the other begins is what costs least.
void write_jacobian(Trace& trace, const CodeModel& code, int link);

}  // namespace dyngen
