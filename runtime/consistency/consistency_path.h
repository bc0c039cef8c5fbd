// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/consistency/consistency_cost.h"

namespace dyngen::runtime {

struct PathResult {
  ScaledParameters parameters;
  bool converged = false;
  int iterations = 0;
};

/// Minimises a ConsistencyCost from its prior by Newton's method, with prior weights that decrease
/// from one that outweighs the data to the wanted one.
///
/// Needed because in log-Cholesky coordinates well and badly known directions form a curved valley
/// in which a least-squares method creeps. In S the data are linear and the log-det divergence is
/// its own barrier, self-concordant: each Newton step is a linear least-squares problem,
///
///     min  ||A dx + r||^2 + w/2 sum ||V^-1 dS V^-T + V'V - 1||^2 + w ||da + a - a0||^2,  S = V V',
///
/// solved by QR (normal equations would square its condition). Bounds a >= 0 by an active set.
/// Source: Boyd and Vandenberghe, "Convex Optimization", 2004, chapters 9 and 11.
PathResult follow_path(const ConsistencyCost& cost);

}  // namespace dyngen::runtime
