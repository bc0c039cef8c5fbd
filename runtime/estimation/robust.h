// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/estimation/least_squares.h"
#include "runtime/estimation/rows.h"

namespace dyngen::runtime {

struct RobustOptions {
  double threshold = 1.345;  ///< in standard deviations: residuals above it count less
  int most_rounds = 30;
  double tolerance = 1e-6;  ///< relative change of the scale and of beta at which to stop
};

/// A fit in which single wild torques have little to say.
struct RobustEstimate {
  Estimate estimate;
  TorqueFactor factor;           ///< of the weighted equations
  Eigen::VectorXd deviation;     ///< (n) robust standard deviation of each joint's residual
  Eigen::VectorXd downweighted;  ///< (n) part of each joint's equations that counted less
  int rounds = 0;
  RowSource rows;  ///< the weighted equations, for what looks at the samples again
};

/// Iteratively reweighted least squares with Huber's weights min(1, threshold * sigma_j / |e|);
/// sigma_j by Huber's proposal 2, so that joints are weighted as well.
///
/// Every round looks at all samples once.
/// Source: Huber, "Robust Statistics", 1981, ch. 7.
RobustEstimate iteratively_reweighted(const RowSource& source,
                                      const std::vector<std::vector<int>>& columns, int parameters,
                                      const RobustOptions& options = {});

}  // namespace dyngen::runtime
