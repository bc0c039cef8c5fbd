// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes the Coriolis matrix in Christoffel form as the output "C", n x n, row-major:
/// C_ij = sum over k of Gamma_ijk dq_k, with the Christoffel symbols of the first kind
/// Gamma_ijk = (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i) / 2. C dq = c, and dM/dt - 2 C is skew.
///
/// Since Gamma_ijk = Gamma_ikj and c_i = sum of Gamma_ijk dq_j dq_k, C is half of the derivative
/// of c by dq: it is written as write_derivatives() writes that one, without the factor 2.
/// Numeric algorithms for the same matrix: Echeandia and Wensing, "Numerical Methods to Compute the
/// Coriolis Matrix and Christoffel Symbols for Rigid-Body Systems" (J. Computational and Nonlinear
/// Dynamics, 2021).
void write_coriolis_matrix(Trace& trace, const CodeModel& code);

/// Writes another matrix C with C dq = c as the output "C", n x n, row-major, for fewer operations.
/// dM/dt - 2 C is not skew; dq . (dM/dt - 2 C) dq = 0 holds, since C dq = c.
///
/// With the joints' rates constant, joint j adds the acceleration
///   (w_(j-1) + w_j) x (z_j x r) dq_j   to a point at r from its origin (revolute),
///   2 w_j x z_j dq_j                   (prismatic),
/// with w the angular velocities of the links. Element ij is the work of its forces in a unit
/// motion of joint i: column j reads no velocity beyond joint j, and composite bodies at rest
/// suffice, while Christoffel's form moves them.
void write_coriolis_matrix_fast(Trace& trace, const CodeModel& code);

}  // namespace dyngen
