// SPDX-License-Identifier: MIT
// What a recorded robot did, by a smoothing of our own.
#pragma once

#include <Eigen/Core>

#include "tests/blind/real/table.h"

namespace blind {

/// (N) and (N x joints): s, rad, rad/s, rad/s^2, N m.
struct RealMotion {
  Eigen::VectorXd t;
  Eigen::MatrixXd q, dq, ddq, tau;

  [[nodiscard]] Eigen::Index samples() const { return t.size(); }
  [[nodiscard]] Eigen::Index joints() const { return q.cols(); }
};

/// Around each sample a cubic is fitted to the positions at their own times, near ones weighing
/// more (Epanechnikov's kernel); it gives position, velocity and acceleration.
/// @param reach  s to either side
RealMotion motion_of(const Table& table, double reach);

/// The mean around given times, by a raised cosine that ends `reach` s to either side.
Eigen::MatrixXd averaged(const Eigen::VectorXd& t, const Eigen::MatrixXd& columns,
                         const Eigen::VectorXd& at, double reach);

}  // namespace blind
