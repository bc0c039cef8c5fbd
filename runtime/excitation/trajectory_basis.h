// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

enum class TrajectoryForm { kFourier, kSpline };

/// A family of motions that begin and end at rest, in the same position: speed and acceleration are
/// 0 there, so that periods follow each other smoothly.
struct TrajectoryFamily {
  TrajectoryForm form = TrajectoryForm::kFourier;
  double duration = 10;  ///< s, one period
  /// Fourier: sines and cosines of 1 .. harmonics periods in the duration, at least 2.
  /// Splines: twice as many inner control points, so that both have about as many parameters.
  int harmonics = 5;

  /// @throws std::invalid_argument  naming what was found and what was expected
  void validate() const;
  /// Parameters of one joint, m: the position of the ends (Fourier: the mean), then shapes.
  [[nodiscard]] int size() const;
};

/// The functions of time that a joint's motion is a sum of, and their derivatives: q = Q x.
struct TrajectoryBasis {
  Eigen::VectorXd time;  ///< (N) s
  Eigen::MatrixXd Q;     ///< (N x m); its first column is 1
  Eigen::MatrixXd dQ;    ///< (N x m) per s
  Eigen::MatrixXd ddQ;   ///< (N x m) per s^2

  /// @param x  (m x n): a column of parameters for each joint
  [[nodiscard]] JointMotion motion(const Eigen::MatrixXd& x) const;
  /// The gradient by x of what has this gradient by the motion, (m x n).
  [[nodiscard]] Eigen::MatrixXd pull_back(const JointMotion& gradient) const;
};

/// The family at these times, 0 .. duration.
///
/// Fourier: q = c + sum_k (a_k sin(w_k t) + b_k cos(w_k t)), w_k = 2 pi k / duration, as in Swevers
/// et al., "Optimal robot excitation and identification" (1997). Speed and acceleration at t = 0
/// are sum w_k a_k and -sum w_k^2 b_k: the coefficients run in the spaces where these vanish.
/// Splines: quintic B-splines on uniform knots, clamped (de Boor, "A practical guide to splines",
/// 1978); the first three and the last three control points are one.
TrajectoryBasis basis_at(const TrajectoryFamily& family, const Eigen::VectorXd& time);

/// count instants of one period, from 0 on; the end, which is the start again, is left out.
Eigen::VectorXd period_times(const TrajectoryFamily& family, Eigen::Index count);

}  // namespace dyngen::runtime
