// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/kinematics/kinematics.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Which parts of tau = M ddq + c + g + IA ddq + friction are written.
struct RneaTerms {
  MotionTerms motion;
  bool rotor = true;     ///< IA ddq
  bool friction = true;  ///< FS sign(dq) + FV dq + OFF
  bool wrench = true;    ///< the last link's, if the model has one
  bool effects = false;  ///< those of the model
};

/// Writes tau by customised Newton-Euler in a given form, as the output array "tau" (N m, N if
/// prismatic); with effects that have states, the members of the state too.
///
/// Source: Khalil and Dombre 2002, ch. 9.
void write_rnea(Trace& trace, const CodeModel& code, const RneaTerms& terms, const RneaForm& form);

/// Writes force and moment of the links on each joint, about the origin and in the axes of its
/// link's frame (whose z is the joint's axis), as the output array "w": 6 x n, row-major, rows fx
/// fy fz nx ny nz. Without rotor and friction. The parameters must be those of bodies: regrouped
/// ones give the same torque, not the same wrench.
void write_joint_wrenches(Trace& trace, const CodeModel& code);

}  // namespace dyngen
