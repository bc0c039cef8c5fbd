// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/consistency/consistency_cost.h"

namespace dyngen::runtime {

struct NewtonResult {
  ScaledParameters parameters;
  std::vector<bool> at_zero;  ///< (na) actuators that are held at 0 by their bound
  bool converged = false;
  int iterations = 0;
};

/// Minimises a ConsistencyCost by Newton's method in S and a, from a point that is near.
///
/// Data are linear in S and the divergence is self-concordant: with V V' = S each step is
///
///     min  ||A dx + r||^2 + w/2 sum ||V^-1 dS V^-T + V'V - 1||^2 + w ||da + a - a0||^2.
///
/// Actuators that may not be negative are held at 0 by an active set, which starts with at_zero.
/// Source: Boyd and Vandenberghe, "Convex Optimization", 2004, chapter 9.
NewtonResult minimise_by_newton(const ConsistencyCost& cost, const ScaledParameters& start,
                                const std::vector<bool>& at_zero);

}  // namespace dyngen::runtime
