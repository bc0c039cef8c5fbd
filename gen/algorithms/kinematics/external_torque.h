// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes the torque that a wrench on the file's frame of a link puts on the joints, tau = J^T w
/// with the Jacobian of write_jacobian(), as the output "tau", n. The wrench is the input w: force
/// and moment about the frame's origin, in the axes of frame 0. Joints that do not carry the link
/// get 0.
///
/// Force and moment are turned into the frames on the way to the link; each joint takes its
/// component of w_n + (link's origin - joint's origin) x w_f. The Jacobian itself is not written.
void write_external_torque(Trace& trace, const CodeModel& code, int link);

}  // namespace dyngen
