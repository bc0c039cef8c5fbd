// SPDX-License-Identifier: MIT
#include "tests/blind/real/motion_of_table.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

namespace blind {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RealMotion motion_of(const Table& table, double reach) {
  RealMotion motion;
  motion.t = table.column("time");
  motion.t.array() -= motion.t[0];
  motion.tau = table.by_joint("tau");
  const MatrixXd recorded = table.by_joint("q");
  const Index n = motion.t.size(), joints = recorded.cols();
  motion.q = motion.dq = motion.ddq = MatrixXd::Zero(n, joints);
  Index low = 0, high = 0;
  for (Index k = 0; k < n; ++k) {
    while (motion.t[k] - motion.t[low] >= reach) ++low;
    while (high < n && motion.t[high] - motion.t[k] < reach) ++high;
    Eigen::Matrix4d gram = Eigen::Matrix4d::Zero();
    Eigen::Matrix<double, 4, Eigen::Dynamic> toward = MatrixXd::Zero(4, joints);
    for (Index i = low; i < high; ++i) {
      const double u = (motion.t[i] - motion.t[k]) / reach, weight = 1 - u * u;
      const Eigen::Vector4d powers(1, u, u * u, u * u * u);
      gram += weight * powers * powers.transpose();
      toward += weight * powers * (recorded.row(i) - recorded.row(k));
    }
    const MatrixXd cubic = gram.ldlt().solve(toward);
    motion.q.row(k) = recorded.row(k) + cubic.row(0);
    motion.dq.row(k) = cubic.row(1) / reach;
    motion.ddq.row(k) = 2 * cubic.row(2) / (reach * reach);
  }
  return motion;
}

MatrixXd averaged(const VectorXd& t, const MatrixXd& columns, const VectorXd& at, double reach) {
  MatrixXd means(at.size(), columns.cols());
  Index low = 0;
  for (Index k = 0; k < at.size(); ++k) {
    while (low + 1 < t.size() && at[k] - t[low] >= reach) ++low;
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(columns.cols());
    double weights = 0;
    for (Index i = low; i < t.size() && t[i] - at[k] < reach; ++i) {
      const double weight = 1 + std::cos(std::numbers::pi * (t[i] - at[k]) / reach);
      sum += weight * columns.row(i);
      weights += weight;
    }
    means.row(k) = sum / weights;
  }
  return means;
}

}  // namespace blind
