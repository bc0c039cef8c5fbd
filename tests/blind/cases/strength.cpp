// SPDX-License-Identifier: MIT
#include "tests/blind/cases/strength.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

using Eigen::MatrixXd;

/// Ten point masses of 1 kg whose pseudo-inertias span all.
std::vector<Inertia> point_masses() {
  std::vector<Inertia> points;
  const auto add = [&](double x, double y, double z) {
    Inertia point;
    point.mass = 1;
    point.com = Eigen::Vector3d(x, y, z);
    points.push_back(point);
  };
  add(0, 0, 0);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d e = Eigen::Vector3d::Unit(k), f = Eigen::Vector3d::Unit((k + 1) % 3);
    add(e.x(), e.y(), e.z());
    add(-e.x(), -e.y(), -e.z());
    add(e.x() + f.x(), e.y() + f.y(), e.z() + f.z());
  }
  return points;
}

}  // namespace

MatrixXd base_columns(const Machine& machine, const Log& log) {
  const Index n = machine.joints(), samples = log.q.rows();
  MatrixXd columns = MatrixXd::Zero(samples * n, 14 * n);
  const auto torque = torque_of_each(machine.tree, point_masses());
  for (Index k = 0; k < samples; ++k) {
    const MatrixXd each = torque(log.q.row(k), log.dq.row(k), log.ddq.row(k));
    for (Index j = 0; j < n; ++j) columns.row(j * samples + k).head(10 * n) = each.row(j);
  }
  for (Index j = 0; j < n; ++j) {
    const Index own = 10 * n + 4 * j;
    columns.block(j * samples, own, samples, 1) = log.ddq.col(j);
    columns.block(j * samples, own + 1, samples, 1) = log.sign.col(j);
    columns.block(j * samples, own + 2, samples, 1) = log.dq.col(j);
    columns.block(j * samples, own + 3, samples, 1).setOnes();
  }
  return columns;
}

VectorXd base_torque(const Machine& machine, const Log& log) {
  const Engine engine = mujoco_engine(machine.tree);
  MatrixXd tau(log.q.rows(), machine.joints());
  for (Index k = 0; k < tau.rows(); ++k) {
    tau.row(k) = engine.inverse(log.q.row(k), log.dq.row(k), log.ddq.row(k)) + machine.offset +
                 machine.armature.cwiseProduct(log.ddq.row(k).transpose()) +
                 machine.coulomb.cwiseProduct(log.sign.row(k).transpose()) +
                 machine.viscous.cwiseProduct(log.dq.row(k).transpose());
  }
  return torque_rows(tau);
}

VectorXd torque_rows(const MatrixXd& by_joint) {
  return Eigen::Map<const VectorXd>(by_joint.data(), by_joint.size());
}

Refit::Refit(std::vector<MatrixXd> whitened) : columns_(std::move(whitened)) {
  const Index n = columns_.front().cols();
  MatrixXd gram = MatrixXd::Zero(n, n);
  for (const MatrixXd& part : columns_) {
    gram.selfadjointView<Eigen::Lower>().rankUpdate(part.transpose());
  }
  gram = gram.selfadjointView<Eigen::Lower>();
  scale_ = gram.diagonal().cwiseSqrt();
  for (double& each : scale_) each = each > 0 ? 1 / each : 0;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale_.asDiagonal() * gram *
                                                      scale_.asDiagonal());
  VectorXd values = eigen.eigenvalues();
  for (double& each : values) each = each > 1e-11 * values.maxCoeff() ? 1 / each : 0;
  inverse_ = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

VectorXd Refit::solve(const std::vector<VectorXd>& rows) const {
  VectorXd answer = VectorXd::Zero(scale_.size());
  std::vector<VectorXd> left = rows;
  for (int round = 0; round < 3; ++round) {  // the Gram matrix squares the condition
    VectorXd right = VectorXd::Zero(scale_.size());
    for (std::size_t i = 0; i < left.size(); ++i) right += columns_[i].transpose() * left[i];
    answer += scale_.cwiseProduct(inverse_ * scale_.cwiseProduct(right));
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = rows[i] - columns_[i] * answer;
  }
  return answer;
}

std::vector<VectorXd> Refit::residual(const std::vector<VectorXd>& rows) const {
  const VectorXd answer = solve(rows);
  std::vector<VectorXd> left = rows;
  for (std::size_t i = 0; i < left.size(); ++i) left[i] -= columns_[i] * answer;
  return left;
}

double squares(const std::vector<VectorXd>& rows) {
  double sum = 0;
  for (const VectorXd& each : rows) sum += each.squaredNorm();
  return sum;
}

}  // namespace blind
