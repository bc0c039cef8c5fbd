// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>

#include "runtime/estimation/torque_factor.h"

namespace dyngen::runtime {

/// Equations of consecutive samples.
struct RowBlock {
  Eigen::MatrixXd Y;    ///< (N x n * nb) as LinearModel::regressor gives it
  Eigen::MatrixXd tau;  ///< (N x n)
  /// (N x n) 1, or 0 where an equation is left out (its Y and tau are 0 then); 0 x 0: all count
  Eigen::MatrixXd counted;
  bool continues_run = false;  ///< the first sample follows the last one of the block before
};

/// Gives all blocks of a set of recordings, in order; may be called again, for estimators that look
/// at the samples more than once.
using RowSource = std::function<void(const std::function<void(const RowBlock&)>&)>;

/// How many equations of each joint count.
Eigen::VectorXd counted_rows(const RowBlock& block);

/// Sets to 0 the columns of a joint's regressor whose elements are rounding beside its largest one.
/// cos(pi/2) is 6e-17: what a posture hides would count as seen, once its column has unit length.
/// @param Y  (N x n nb), as LinearModel::regressor makes it
void clear_rounding(Eigen::MatrixXd& Y, Eigen::Index joints);

/// Adds a block's equations to a factor.
void absorb(TorqueFactor& factor, const RowBlock& block);

/// tau - Y beta. @return (N x n)
Eigen::MatrixXd residual(const RowBlock& block, const Eigen::VectorXd& beta);

/// All equations of a source. @param columns  of LinearModel
TorqueFactor factor_of(const RowSource& source, const std::vector<std::vector<int>>& columns,
                       int parameters);

}  // namespace dyngen::runtime
