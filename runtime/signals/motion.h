// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// One run with its joint state: what regressors are evaluated at. Uniformly sampled.
///
/// Matrices are column-major, one column a joint: the samples of a joint stand together, as batch
/// functions want them (q[j*n + k]).
struct Motion {
  double sample_time = 0;  ///< s
  Eigen::VectorXd time;    ///< (N) s
  Eigen::MatrixXd q;       ///< (N x n) rad or m
  Eigen::MatrixXd dq;      ///< (N x n)
  Eigen::MatrixXd ddq;     ///< (N x n)
  Eigen::MatrixXd tau;     ///< (N x n) as measured, or what a simulator says
  /// (N x n) of each joint, as it was recorded; 0 x 0 if it was not
  Eigen::MatrixXd temperature{};
  double period = 0;  ///< s after which the motion repeats, of the run that it is a part of; 0: it
                      ///< does not

  [[nodiscard]] Eigen::Index samples() const { return time.size(); }
  [[nodiscard]] int joints() const { return static_cast<int>(q.cols()); }
};

}  // namespace dyngen::runtime
