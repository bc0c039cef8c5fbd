// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "runtime/estimation/least_squares.h"
#include "runtime/estimation/rows.h"

namespace dyngen::runtime {

/// Equations with the instruments that go with them: the same rows as Z and as Y.
struct InstrumentBlock {
  RowBlock rows;
  Eigen::MatrixXd Z;  ///< (N x n * nb): the regressor of a motion that the noise does not touch
};
using InstrumentSource = std::function<void(const std::function<void(const InstrumentBlock&)>&)>;

/// What instrumental variables say.
struct InstrumentalEstimate {
  Estimate estimate;
  /// Smallest cosine between what instruments and regressor span: near 0 they are too weak.
  double relevance = 0;
  /// Durbin, Wu and Hausman: chi-square of the part of the regressor that instruments do not
  /// explain, in the torque. Large: the regressor is correlated with the noise, and least squares
  /// are biased.
  double hausman = 0;
  int degrees = 0;
  double p_value = 1;
};

/// The estimate (Z'W)^-1 Z' tau_all, each joint times its weight, with a covariance for noise that
/// is correlated in time, and the test that says whether it was needed.
///
/// The test regresses torque on [W, W - Z (Z'Z)^-1 Z'W] and asks whether the second half has
/// coefficients, with the same covariance.
/// @param joint_weights  (n)
/// Source: Janot, Vandanjon and Gautier, "A generic instrumental variable approach for industrial
/// robot identification", IEEE T-CST 2014 (the simulated regressor); Hausman, 1978 (the test).
InstrumentalEstimate instrumental_variables(const InstrumentSource& source,
                                            const std::vector<std::vector<int>>& columns,
                                            int parameters, const Eigen::VectorXd& joint_weights);

}  // namespace dyngen::runtime
