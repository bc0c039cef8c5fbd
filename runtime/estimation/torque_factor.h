// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// The equations of one joint over all samples, tau = Y beta, summed up by their triangular factor.
struct JointFactor {
  /// Upper triangular, diagonal >= 0, R'R = [Y tau]'[Y tau]: (n + 1 x n + 1) for the n parameters
  /// that can act on the joint.
  Eigen::MatrixXd R;
  double rows = 0;  ///< how many equations are in it
};

/// The equations of a robot, joint by joint: all that linear estimators need of any number of
/// samples.
///
/// Joints are kept apart so that their weights can be chosen afterwards, and because an outer joint
/// sees few of the parameters.
struct TorqueFactor {
  std::vector<std::vector<int>> columns;  ///< of LinearModel
  int parameters = 0;                     ///< nb
  std::vector<JointFactor> joints;

  /// Samples of the joint that has most: equations of a joint at rest may be left out.
  [[nodiscard]] double samples() const;
};

/// A factor without equations.
/// @throws std::invalid_argument  if a column is not in 0 .. parameters - 1
TorqueFactor empty_factor(const std::vector<std::vector<int>>& columns, int parameters);

/// Adds the equations of a block of samples by an orthogonal transformation: what is squared in the
/// normal equations is not squared here.
///
/// @param Y    (N x n * nb) as LinearModel::regressor gives it         @param tau  (N x n)
/// @throws std::invalid_argument  if a size is wrong
void absorb(TorqueFactor& factor, const Eigen::MatrixXd& Y, const Eigen::MatrixXd& tau);

/// The same for one joint. @param A  (N x n + 1): [Y tau] of the parameters that act on it; used as
/// workspace
void absorb(JointFactor& joint, Eigen::MatrixXd& A);

/// Adds the equations of another factor of the same robot. Associative and commutative but for
/// rounding. @throws std::invalid_argument  if it is of another model
void merge(TorqueFactor& factor, const TorqueFactor& other);

/// All equations of all joints, each joint times its weight, as rows over all nb parameters.
struct StackedRows {
  Eigen::MatrixXd W;    ///< (m x nb), m at most the sum of n + 1
  Eigen::VectorXd tau;  ///< (m)
};
/// @param joint_weights  (n) 1/sigma of each joint; ones for ordinary least squares
StackedRows stacked(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights);

/// ||tau_j - Y_j beta||^2 of every joint, exactly as over all samples.
Eigen::VectorXd residual_squares(const TorqueFactor& factor, const Eigen::VectorXd& beta);

/// ||tau_j||^2 of every joint.
Eigen::VectorXd torque_squares(const TorqueFactor& factor);

/// ||Y_c||, the norm of each parameter's column over all joints times their weights: (nb).
Eigen::VectorXd column_norms(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights);

}  // namespace dyngen::runtime
