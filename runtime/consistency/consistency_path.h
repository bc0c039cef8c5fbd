// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/consistency/consistency_newton.h"

namespace dyngen::runtime {

/// Minimises a ConsistencyCost by interior-point steps in S and a.
///
/// In log-Cholesky coordinates well and badly known directions form a curved valley, in which a
/// least-squares method creeps. In S the data are linear, and the log-det divergence is a linear
/// term and a logarithmic barrier: the minimum is the point of a central path where S Z = w, Z the
/// multiplier of S. Primal-dual steps follow it, with the scaling of Nesterov and Todd and
/// Mehrotra's corrector, each of them a linear least-squares problem,
///
///     min  ||A dx + r||^2 + w ||da + a - a0||^2 + 1/2 sum ||G^-1 dS G^-T + gradient||^2,
///
/// solved by QR (normal equations would square its condition). Actuators that go to 0 there are
/// put to 0, and minimise_by_newton() ends the search.
/// Source: Boyd and Vandenberghe, "Convex Optimization", 2004, chapters 9 to 11; Nesterov and Todd,
/// "Primal-dual interior-point methods for self-scaled cones", 1998.
NewtonResult follow_path(const ConsistencyCost& cost);

}  // namespace dyngen::runtime
