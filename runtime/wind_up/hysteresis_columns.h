// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// A rate-independent hysteresis between -1 and 1: after a reversal of `driver` it approaches the
/// other end within some `reach` of travel, however fast. dz/dx = (1 - z sign(dx)) / reach.
/// Each run begins at the end of its own first direction.
/// Source: Dahl 1968, of exponent 1.
Eigen::VectorXd hysteresis_column(const Eigen::VectorXd& driver,
                                  const std::vector<Eigen::Index>& run_starts, double reach);

}  // namespace dyngen::runtime
