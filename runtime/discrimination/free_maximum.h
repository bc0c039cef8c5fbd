// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

namespace dyngen::runtime {

struct FreeMaximumOptions {
  int evaluations = 0;      ///< at most; 0: the time ends it
  double seconds = 1e9;     ///< at most; what ends by the clock is not repeated exactly
  double first_step = 0.1;  ///< of every number
  double tolerance = 1e-4;  ///< of the numbers: done
};

struct FreeMaximum {
  Eigen::VectorXd x;
  double value = 0;
  int evaluations = 0;
};

/// The largest value found of a function of numbers in 0 .. 1 that has no derivative, from `start`;
/// never less than there. By Subplex (NLopt's LN_SBPLX).
/// Source: Rowan, "Functional stability analysis of numerical algorithms", PhD thesis, University
/// of Texas at Austin, 1990.
FreeMaximum free_maximum(const std::function<double(const Eigen::VectorXd&)>& value,
                         const Eigen::VectorXd& start, const FreeMaximumOptions& options);

}  // namespace dyngen::runtime
