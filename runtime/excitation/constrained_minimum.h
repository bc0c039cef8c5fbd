// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

namespace dyngen::runtime {

/// A smooth function and its constraints at one point.
struct SmoothPoint {
  double value = 0;             ///< may be infinite: outside of what is defined
  Eigen::VectorXd gradient;     ///< (n)
  Eigen::VectorXd constraints;  ///< (c), kept where <= 0
  Eigen::MatrixXd jacobian;     ///< (c x n)
};

struct MinimumOptions {
  int evaluations = 200;    ///< at most
  double seconds = 1e9;     ///< at most; what ends by the clock is not repeated exactly
  double tolerance = 1e-4;  ///< of the value between steps: done
  double violation = 1e-3;  ///< of a constraint that counts as kept
  /// The first step is this times the gradient: long ones leave the constraints far behind.
  double first_step = 0.05;
};

struct Minimum {
  Eigen::VectorXd x;
  double value = 0;
  double violation = 0;  ///< the largest constraint, or 0
  int evaluations = 0;
};

/// The least value found from `start` with constraints kept; if none keeps them, the point that
/// violates them least. Never worse than the start. By sequential quadratic programming (NLopt's
/// SLSQP; Kraft 1988).
/// @param at  is asked for every point once
Minimum constrained_minimum(const std::function<SmoothPoint(const Eigen::VectorXd&)>& at,
                            const Eigen::VectorXd& start, const MinimumOptions& options);

}  // namespace dyngen::runtime
