// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// The output arrays of the derivatives; an empty name: not written.
struct DerivativeOutputs {
  std::string position{};      ///< d tau_i / d q_j
  std::string velocity{};      ///< d tau_i / d dq_j; sign(dq) has the derivative 0
  std::string acceleration{};  ///< d tau_i / d ddq_j, the mass matrix
};

/// Writes derivatives of the inverse dynamics as n x n matrices, row-major.
///
/// Bodies are composed from the tips to the base (MovingBody). What a composite body adds to the
/// derivatives by its own joint i is a force or moment that is carried on to every joint j below
/// it; what the joints j below add to the torque of i is the work of two more of them in the
/// motion of j.
///
/// Source: the closed forms with composite inertia I and Coriolis matrix B of Singh, Russell and
/// Wensing, "Efficient Analytical Derivatives of Rigid-Body Dynamics using Spatial Vector Algebra"
/// (IEEE Robotics and Automation Letters, 2022); earlier Carpentier and Mansard (RSS 2018). What is
/// ours: each body is seen against its joint's origin in place and velocity, so that of B only
/// integrals of v r^T and v are left and the derivative of a joint's screw has no linear part, and
/// everything meets in axes that stand on the joint but do not turn with it.
void write_derivatives(Trace& trace, const CodeModel& code, const DerivativeOutputs& outputs);

/// Writes half of the derivative of the Coriolis torque by the velocities: n x n, row-major. It is
/// the Coriolis matrix in Christoffel form.
void write_half_velocity_derivative(Trace& trace, const CodeModel& code, const std::string& array);

}  // namespace dyngen
