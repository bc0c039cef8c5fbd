// SPDX-License-Identifier: MIT
#include "tests/blind/real/shown.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRate = 50;     // samples a second
constexpr double kStill = 0.02;  // of the largest speed: the sign of friction is not known
constexpr double kRank = 1e-7;
constexpr Index kMemory = 6;  // samples
constexpr Index kOfLink = 10;

/// A motion at other times; torque and state pass the same average.
RealMotion thinned(const RealMotion& motion, const VectorXd& at) {
  RealMotion thin;
  thin.t = at;
  for (MatrixXd RealMotion::*part :
       {&RealMotion::q, &RealMotion::dq, &RealMotion::ddq, &RealMotion::tau}) {
    thin.*part = averaged(motion.t, motion.*part, at, 1 / kRate);
  }
  return thin;
}

/// Rigid bodies, then rotor, viscous and dry friction and offset of each joint.
MatrixXd base_columns(const RealRobot& robot, const RealMotion& full, const RealMotion& thin) {
  const Index n = thin.samples(), joints = thin.joints();
  MatrixXd columns = MatrixXd::Zero(n * joints, (kOfLink + 4) * joints);
  columns.leftCols(kOfLink * joints) = rigid_columns(robot, thin);
  const MatrixXd sign = averaged(full.t, full.dq.cwiseSign(), thin.t, 1 / kRate);
  for (Index j = 0; j < joints; ++j) {
    auto own = columns.block(j * n, kOfLink * joints + 4 * j, n, 4);
    own << thin.ddq.col(j), thin.dq.col(j), sign.col(j), VectorXd::Ones(n);
  }
  return columns;
}

/// Coefficients and deviation of the innovation, by Yule and Walker.
std::pair<VectorXd, double> autoregression(const std::vector<VectorXd>& pieces) {
  VectorXd covariance = VectorXd::Zero(kMemory + 1);
  double count = 0;
  for (const VectorXd& e : pieces) {
    count += static_cast<double>(e.size());
    for (Index lag = 0; lag <= std::min(kMemory, e.size() - 1); ++lag) {
      covariance[lag] += e.head(e.size() - lag).dot(e.tail(e.size() - lag));
    }
  }
  covariance /= count;
  MatrixXd toeplitz(kMemory, kMemory);
  for (Index a = 0; a < kMemory; ++a) {
    for (Index b = 0; b < kMemory; ++b) toeplitz(a, b) = covariance[std::abs(a - b)];
  }
  const VectorXd memory = toeplitz.ldlt().solve(covariance.tail(kMemory));
  return {memory, std::sqrt(covariance[0] - memory.dot(covariance.tail(kMemory)))};
}

}  // namespace

Shown::Shown(const RealRobot& robot, const std::vector<RealMotion>& motions) : robot_(robot) {
  const Index joints = motions.front().joints();
  VectorXd fastest = VectorXd::Zero(joints);
  for (const RealMotion& motion : motions) {
    fastest = fastest.cwiseMax(motion.dq.cwiseAbs().colwise().maxCoeff().transpose());
  }
  std::vector<RealMotion> thin;
  std::vector<MatrixXd> columns;
  MatrixXd all(0, (kOfLink + 4) * joints);
  VectorXd torque(0), counted(0);
  for (const RealMotion& motion : motions) {
    const double last = motion.t[motion.samples() - 1];
    times_.push_back(VectorXd::LinSpaced(static_cast<Index>(last * kRate), 0, last));
    full_times_.push_back(motion.t);
    thin.push_back(thinned(motion, times_.back()));
    const RealMotion& own = thin.back();
    columns.push_back(base_columns(robot, motion, own));
    counted_.push_back((own.dq.cwiseAbs().array() >
                        (kStill * fastest).transpose().replicate(own.samples(), 1).array())
                           .cast<double>());
    const Index before = all.rows(), more = columns.back().rows();
    all.conservativeResize(before + more, Eigen::NoChange);
    all.bottomRows(more) = columns.back();
    torque.conservativeResize(before + more);
    torque.tail(more) = own.tau.reshaped();
    counted.conservativeResize(before + more);
    counted.tail(more) = counted_.back().reshaped();
  }
  // joints weigh by their torque: the fit that tells what noise is
  VectorXd weight(torque.size());
  const MatrixXd& first = motions.front().tau;
  Index row = 0;
  for (const RealMotion& own : thin) {
    for (Index j = 0; j < joints; ++j, row += own.samples()) {
      weight.segment(row, own.samples()).setConstant(1 / first.col(j).norm());
    }
  }
  weight = weight.cwiseProduct(counted);
  VectorXd scale = (weight.asDiagonal() * all).colwise().norm().transpose();
  for (double& each : scale) each = each > 0 ? 1 / each : 1;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver;
  solver.setThreshold(kRank);
  solver.compute(weight.asDiagonal() * all * scale.asDiagonal());
  const VectorXd fitted = scale.asDiagonal() * solver.solve(weight.cwiseProduct(torque));
  rigid_ = fitted.head(kOfLink * joints);
  dry_.resize(joints);
  innovation_.resize(joints);
  memory_.resize(static_cast<std::size_t>(joints));
  for (Index j = 0; j < joints; ++j) {
    dry_[j] =
        std::max(fitted[kOfLink * joints + 4 * j + 2], 0.01 * first.col(j).cwiseAbs().maxCoeff());
    std::vector<VectorXd> pieces;
    for (std::size_t r = 0; r < thin.size(); ++r) {
      const Index n = thin[r].samples();
      const VectorXd left = thin[r].tau.col(j) - columns[r].middleRows(j * n, n) * fitted;
      pieces.push_back(left.cwiseProduct(counted_[r].col(j)));
    }
    std::tie(memory_[static_cast<std::size_t>(j)], innovation_[j]) = autoregression(pieces);
  }
  MatrixXd white(all.rows(), all.cols());
  row = 0;
  for (std::size_t r = 0; r < thin.size(); ++r) {
    const Index more = columns[r].rows();
    white.middleRows(row, more) = whitened(r, columns[r]);
    row += more;
  }
  for (Index c = 0; c < white.cols(); ++c) {
    const double length = white.col(c).norm();
    if (length > 0) white.col(c) /= length;
  }
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(kRank);
  qr.compute(white);
  basis_ = qr.householderQ() * MatrixXd::Identity(white.rows(), qr.rank());
}

MatrixXd Shown::whitened(std::size_t recording, MatrixXd rows) const {
  const MatrixXd& counted = counted_[recording];
  const Index n = counted.rows();
  const MatrixXd plain = rows;
  for (Index j = 0; j < counted.cols(); ++j) {
    const VectorXd& memory = memory_[static_cast<std::size_t>(j)];
    auto own = rows.middleRows(j * n, n);
    for (Index lag = 1; lag <= memory.size(); ++lag) {
      own.bottomRows(n - lag) -= memory[lag - 1] * plain.middleRows(j * n, n - lag);
    }
    own = (counted.col(j) / innovation_[j]).asDiagonal() * own;
  }
  return rows;
}

VectorXd Shown::stacked(const std::vector<MatrixXd>& added) const {
  VectorXd all(basis_.rows());
  Index row = 0;
  for (std::size_t r = 0; r < added.size(); ++r) {
    const MatrixXd thin = averaged(full_times_[r], added[r], times_[r], 1 / kRate);
    all.segment(row, thin.size()) = whitened(r, thin.reshaped());
    row += thin.size();
  }
  return all;
}

double Shown::squares(const std::vector<MatrixXd>& added) const {
  const VectorXd e = stacked(added);
  return (e - basis_ * (basis_.transpose() * e)).squaredNorm();
}

double Shown::absorbed(const std::vector<MatrixXd>& added) const {
  return 1 - squares(added) / std::max(stacked(added).squaredNorm(), 1e-300);
}

MatrixXd Shown::load(const RealMotion& motion) const {
  const VectorXd& t = motion.t;
  const double last = t[motion.samples() - 1];
  const VectorXd at = VectorXd::LinSpaced(static_cast<Index>(last * kRate), 0, last);
  const MatrixXd thin =
      (rigid_columns(robot_, thinned(motion, at)) * rigid_).reshaped(at.size(), motion.joints());
  MatrixXd full(t.size(), thin.cols());
  Index low = 0;
  for (Index k = 0; k < t.size(); ++k) {
    while (low + 2 < at.size() && at[low + 1] < t[k]) ++low;
    const double u = std::clamp((t[k] - at[low]) / (at[low + 1] - at[low]), 0.0, 1.0);
    full.row(k) = (1 - u) * thin.row(low) + u * thin.row(low + 1);
  }
  return full;
}

}  // namespace blind
