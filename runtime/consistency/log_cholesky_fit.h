// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/consistency/consistency_cost.h"

namespace dyngen::runtime {

struct LogCholeskyFit {
  ScaledParameters parameters;
  std::vector<bool> at_zero;  ///< (na) actuators that are held at 0 by their bound
  std::vector<int> at_floor;  ///< links, from 1, some coordinate of which is at its floor
  bool converged = false;
  int iterations = 0;   ///< of Ceres, over all rounds
  std::string message;  ///< what Ceres says if it has not converged
};

/// Minimises a ConsistencyCost by Ceres (Levenberg-Marquardt), from `start`.
///
/// One block of ten log-Cholesky coordinates a link, those of the factor V of S = V V', and one of
/// actuators. The divergence D(S || 1) is exactly a sum of ten squares, those of the elements of V
/// above the diagonal and of g(log V_ii), g(u)^2 = exp(2 u) - 2 u - 1. Lower bounds: log(floor) on
/// alpha and d1..d3, 0 on IA, FV, FS. Since a bounded Levenberg-Marquardt step is only cut, what
/// reaches a bound and pushes against it is held constant in a new round.
LogCholeskyFit fit_log_cholesky(const ConsistencyCost& cost, const ConsistencyOptions& options,
                                const ScaledParameters& start);

}  // namespace dyngen::runtime
