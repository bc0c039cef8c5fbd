// SPDX-License-Identifier: MIT
#include "runtime/estimation/torque_factor.h"

#include <fmt/format.h>

#include <stdexcept>

#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Index place(Index joint, int parameter, Index parameters) { return joint * parameters + parameter; }

}  // namespace

double TorqueFactor::samples() const {
  double most = 0;
  for (const JointFactor& joint : joints) most = std::max(most, joint.rows);
  return most;
}

TorqueFactor empty_factor(const std::vector<std::vector<int>>& columns, int parameters) {
  TorqueFactor factor;
  factor.columns = columns;
  factor.parameters = parameters;
  for (const std::vector<int>& of_joint : columns) {
    for (const int c : of_joint) {
      if (c >= 0 && c < parameters) continue;
      throw std::invalid_argument(
          fmt::format("empty_factor(): column {} of {} parameters: expected 0 to {}", c, parameters,
                      parameters - 1));
    }
    const Index size = static_cast<Index>(of_joint.size()) + 1;
    factor.joints.push_back({MatrixXd::Zero(size, size), 0});
  }
  return factor;
}

void absorb(JointFactor& joint, MatrixXd& A) {
  const Index size = joint.R.rows(), rows = A.rows();
  joint.rows += static_cast<double>(rows);
  if (size == 0 || rows == 0) return;
  MatrixXd block = rows > size ? triangle_in_place(A) : A;
  MatrixXd both(size + block.rows(), size);
  both << joint.R, block;
  joint.R = triangle_in_place(both);
}

void absorb(TorqueFactor& factor, const MatrixXd& Y, const MatrixXd& tau) {
  const Index joints = static_cast<Index>(factor.joints.size());
  if (Y.rows() != tau.rows() || tau.cols() != joints || Y.cols() != joints * factor.parameters) {
    throw std::invalid_argument(fmt::format(
        "absorb(): Y is {} x {}, tau {} x {}; expected {} x {} and {} x {}", Y.rows(), Y.cols(),
        tau.rows(), tau.cols(), tau.rows(), joints * factor.parameters, tau.rows(), joints));
  }
  MatrixXd A;
  for (Index j = 0; j < joints; ++j) {
    const std::vector<int>& columns = factor.columns[static_cast<std::size_t>(j)];
    A.resize(Y.rows(), static_cast<Index>(columns.size()) + 1);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      A.col(static_cast<Index>(i)) = Y.col(place(j, columns[i], factor.parameters));
    }
    A.rightCols(1) = tau.col(j);
    absorb(factor.joints[static_cast<std::size_t>(j)], A);
  }
}

void merge(TorqueFactor& factor, const TorqueFactor& other) {
  if (factor.parameters != other.parameters || factor.columns != other.columns) {
    throw std::invalid_argument(fmt::format(
        "merge(): factors of different models: {} and {} parameters, {} and {} joints",
        factor.parameters, other.parameters, factor.joints.size(), other.joints.size()));
  }
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    JointFactor& joint = factor.joints[j];
    const double rows = joint.rows + other.joints[j].rows;
    MatrixXd block = other.joints[j].R;
    absorb(joint, block);
    joint.rows = rows;
  }
}

StackedRows stacked(const TorqueFactor& factor, const VectorXd& joint_weights) {
  Index rows = 0;
  for (const JointFactor& joint : factor.joints) rows += joint.R.rows();
  StackedRows all;
  all.W = MatrixXd::Zero(rows, factor.parameters);
  all.tau = VectorXd::Zero(rows);
  Index start = 0;
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    const MatrixXd& R = factor.joints[j].R;
    const double weight = joint_weights[static_cast<Index>(j)];
    for (std::size_t i = 0; i < factor.columns[j].size(); ++i) {
      all.W.col(factor.columns[j][i]).segment(start, R.rows()) =
          weight * R.col(static_cast<Index>(i));
    }
    all.tau.segment(start, R.rows()) = weight * R.rightCols(1);
    start += R.rows();
  }
  return all;
}

VectorXd residual_squares(const TorqueFactor& factor, const VectorXd& beta) {
  VectorXd squares(static_cast<Index>(factor.joints.size()));
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    const MatrixXd& R = factor.joints[j].R;
    VectorXd rest = R.rightCols(1);
    for (std::size_t i = 0; i < factor.columns[j].size(); ++i) {
      rest -= R.col(static_cast<Index>(i)) * beta[factor.columns[j][i]];
    }
    squares[static_cast<Index>(j)] = rest.squaredNorm();
  }
  return squares;
}

VectorXd torque_squares(const TorqueFactor& factor) {
  VectorXd squares(static_cast<Index>(factor.joints.size()));
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    squares[static_cast<Index>(j)] = factor.joints[j].R.rightCols(1).squaredNorm();
  }
  return squares;
}

VectorXd column_norms(const TorqueFactor& factor, const VectorXd& joint_weights) {
  VectorXd squares = VectorXd::Zero(factor.parameters);
  for (std::size_t j = 0; j < factor.joints.size(); ++j) {
    const double weight = joint_weights[static_cast<Index>(j)];
    for (std::size_t i = 0; i < factor.columns[j].size(); ++i) {
      squares[factor.columns[j][i]] +=
          weight * weight * factor.joints[j].R.col(static_cast<Index>(i)).squaredNorm();
    }
  }
  return squares.cwiseSqrt();
}

}  // namespace dyngen::runtime
