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
  /// Durbin, Wu and Hausman: chi-square of the difference to least squares with the same weights.
  /// Large: the regressor is correlated with what is left of torque, by noise or by physics that the
  /// model leaves out, and least squares are biased.
  double hausman = 0;
  int degrees = 0;
  double p_value = 1;
  /// The largest difference to least squares, in standard deviations of this estimate: a bias can be
  /// certain and not matter.
  double largest_move = 0;
};

/// The estimate (Z'W)^-1 Z' tau_all, each joint times its weight, with a covariance for noise that
/// is correlated in time, and the test that says whether it was needed.
///
/// The test asks whether the difference of both estimates is larger than noise, which is the same in
/// both, makes it.
/// @param joint_weights  (n)
/// Source: Janot, Vandanjon and Gautier, "A generic instrumental variable approach for industrial
/// robot identification", IEEE T-CST 2014 (the simulated regressor); Hausman, 1978 (the test).
InstrumentalEstimate instrumental_variables(const InstrumentSource& source,
                                            const std::vector<std::vector<int>>& columns,
                                            int parameters, const Eigen::VectorXd& joint_weights);

}  // namespace dyngen::runtime
