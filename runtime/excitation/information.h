// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

/// What of a recording's information is asked about.
struct InformationOptions {
  Eigen::VectorXd torque_noise{};  ///< (n) N m: standard deviation of one sample; empty: 1
  std::vector<int> parameters{};   ///< of the model, ascending: the others are known; empty: all
  double samples = 0;              ///< that are recorded; 0: as many as the motion has
  Eigen::MatrixXd prior{};         ///< (p x p) information there is before; empty: none

  /// @throws std::invalid_argument  naming what was found and what was expected
  void validate(const LinearModel& model) const;
};

/// What a recording of a motion says of p parameters when torque noise is white: the inverse of the
/// covariance of weighted least squares.
struct Information {
  Eigen::MatrixXd R;  ///< (p x p) prior + samples / N sum_k Y_k' diag(1 / sigma^2) Y_k
  Eigen::MatrixXd Y;  ///< (N x n * nb) the regressor of all parameters
};

/// @param motion  (N x n), spread evenly over the recording
/// @throws std::invalid_argument  if a size is wrong
Information information_of(const LinearModel& model, const JointMotion& motion,
                           const InformationOptions& options);

/// The gradient by the motion of a function of R whose gradient by R is G.
/// @param information  of the same motion       @param G  (p x p), symmetric
JointMotion information_gradient(const LinearModel& model, const JointMotion& motion,
                                 const InformationOptions& options, const Information& information,
                                 const Eigen::MatrixXd& G);

/// The largest over the smallest singular value of the stacked regressor over these parameters, all
/// joints alike, in SI units.
/// @param unit_columns  each column is divided by its norm first
double condition_number(const LinearModel& model, const JointMotion& motion,
                        const std::vector<int>& parameters, bool unit_columns = false);

/// Standard deviations of the parameters, (p); infinite where R lacks rank.
Eigen::VectorXd standard_deviations(const Eigen::MatrixXd& R);

}  // namespace dyngen::runtime
