// SPDX-License-Identifier: MIT
#include "runtime/excitation/motion_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::ArrayXd;
using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void check_size(const VectorXd& values, Index size, const char* what) {
  if (values.size() == size) return;
  throw std::invalid_argument(
      fmt::format("MotionLimits: {} has {} values, expected {}", what, values.size(), size));
}

/// Of infinite limits: 0.
VectorXd inverse(const VectorXd& limit) { return limit.cwiseInverse(); }

VectorXd middle(const MotionLimits& limits) { return 0.5 * (limits.lower + limits.upper); }
VectorXd half_range(const MotionLimits& limits) { return 0.5 * (limits.upper - limits.lower); }

/// How far outside a box a point is along the axis on which it is farthest out; by the point.
struct BoxDistance {
  double value = 0;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
};

BoxDistance distance_to(const KeepOutBox& box, const Eigen::Vector3d& point) {
  BoxDistance distance{-std::numeric_limits<double>::infinity()};
  for (Index i = 0; i < 3; ++i) {
    const double above = point[i] - box.upper[i], below = box.lower[i] - point[i];
    if (std::max(above, below) <= distance.value) continue;
    distance.value = std::max(above, below);
    distance.slope.setZero();
    distance.slope[i] = above > below ? 1 : -1;
  }
  return distance;
}

/// log(sum exp(s x)) / s and the weight of each x in it.
struct SoftLargest {
  double value = 0;
  ArrayXXd weights;
};

SoftLargest soft_largest(const ArrayXXd& x, double sharpness) {
  const double largest = x.maxCoeff();
  SoftLargest result;
  result.weights = (sharpness * (x - largest)).exp();
  const double sum = result.weights.sum();
  result.weights /= sum;
  result.value = largest + std::log(sum) / sharpness;
  return result;
}

/// |x| / limit <= 1, as one constraint on a column; derivatives by x.
struct ColumnConstraint {
  double value = 0;
  VectorXd slope;
};

ColumnConstraint bounded(const VectorXd& x, double limit, double sharpness) {
  ArrayXXd both(x.size(), 2);
  both.col(0) = x.array() / limit;
  both.col(1) = -both.col(0);
  const SoftLargest soft = soft_largest(both, sharpness);
  return {soft.value - 1, (soft.weights.col(0) - soft.weights.col(1)).matrix() / limit};
}

void add(MotionConstraints& constraints, double value, JointMotion gradient) {
  const Index count = constraints.values.size();
  constraints.values.conservativeResize(count + 1);
  constraints.values[count] = value;
  constraints.by_motion.push_back(std::move(gradient));
}

MatrixXd in_column(const VectorXd& values, Index column, Index columns) {
  MatrixXd matrix = MatrixXd::Zero(values.size(), columns);
  matrix.col(column) = values;
  return matrix;
}

void add_joint_constraints(MotionConstraints& constraints, const MotionLimits& limits,
                           const JointMotion& motion, double sharpness, double factor) {
  const Index n = motion.q.cols();
  const VectorXd half = half_range(limits), centre = middle(limits);
  for (Index j = 0; j < n; ++j) {
    const VectorXd from_middle = motion.q.col(j).array() - centre[j];
    const ColumnConstraint position = bounded(from_middle, factor * half[j], sharpness);
    add(constraints, position.value, {in_column(position.slope, j, n), {}, {}});
    if (std::isfinite(limits.speed[j])) {
      const ColumnConstraint speed = bounded(motion.dq.col(j), factor * limits.speed[j], sharpness);
      add(constraints, speed.value, {{}, in_column(speed.slope, j, n), {}});
    }
    if (std::isfinite(limits.acceleration[j])) {
      const ColumnConstraint acceleration =
          bounded(motion.ddq.col(j), factor * limits.acceleration[j], sharpness);
      add(constraints, acceleration.value, {{}, {}, in_column(acceleration.slope, j, n)});
    }
  }
}

void add_torque_constraint(MotionConstraints& constraints, const LinearModel& model,
                           const MotionLimits& limits, const JointMotion& motion, double sharpness,
                           double factor) {
  const MatrixXd tau = model.torque(motion.q, motion.dq, motion.ddq, limits.beta);
  const Index n = tau.cols(), samples = tau.rows(), size = model.size();
  ArrayXXd shares(samples, 2 * n);
  shares.leftCols(n) = (tau * inverse(factor * limits.torque).asDiagonal()).array();
  shares.rightCols(n) = -shares.leftCols(n);
  const SoftLargest soft = soft_largest(shares, sharpness);
  MatrixXd A(samples, n * size);
  for (Index j = 0; j < n; ++j) {
    const VectorXd slope =
        (soft.weights.col(j) - soft.weights.col(n + j)).matrix() / (factor * limits.torque[j]);
    A.middleCols(j * size, size) = slope * limits.beta.transpose();
  }
  add(constraints, soft.value - 1, model.regressor_gradient(motion, A));
}

void add_box_constraint(MotionConstraints& constraints, const KeepOutBox& box,
                        const JointMotion& motion, double sharpness, double factor) {
  const Index samples = motion.q.rows();
  ArrayXXd inside(samples, 1);
  MatrixXd slopes(samples, motion.q.cols());
  // a tenth of a metre is the unit of the distance; some of it is kept in hand
  const double unit = 0.1, margin = 0.1 * (1 - factor);
  for (Index k = 0; k < samples; ++k) {
    const ToolPoint tool = box.tool(motion.q.row(k).transpose());
    const BoxDistance distance = distance_to(box, tool.position);
    inside(k, 0) = (margin - distance.value) / unit;
    slopes.row(k) = -(tool.jacobian.transpose() * distance.slope).transpose() / unit;
  }
  const SoftLargest soft = soft_largest(inside, sharpness);
  add(constraints, soft.value, {soft.weights.col(0).matrix().asDiagonal() * slopes, {}, {}});
}

/// The largest |x| of each column, each over its limit.
VectorXd largest_shares(const MatrixXd& x, const VectorXd& limit) {
  return x.cwiseAbs().colwise().maxCoeff().transpose().cwiseProduct(inverse(limit));
}

}  // namespace

void MotionLimits::validate(const LinearModel& model) const {
  const Index n = model.joints();
  check_size(lower, n, "lower");
  check_size(upper, n, "upper");
  check_size(speed, n, "speed");
  check_size(acceleration, n, "acceleration");
  check_size(torque, n, "torque");
  if (beta.size() != 0) check_size(beta, model.size(), "beta");
  for (Index j = 0; j < n; ++j) {
    if (!std::isfinite(lower[j]) || !std::isfinite(upper[j]) || !(lower[j] < upper[j])) {
      throw std::invalid_argument(
          fmt::format("MotionLimits: joint {} may move from {} to {}, expected a finite range",
                      j + 1, lower[j], upper[j]));
    }
    if (!(speed[j] > 0) || !(acceleration[j] > 0) || !(torque[j] > 0)) {
      throw std::invalid_argument(fmt::format(
          "MotionLimits: joint {} has speed {}, acceleration {}, torque {}, expected more than 0",
          j + 1, speed[j], acceleration[j], torque[j]));
    }
  }
}

bool MotionLimits::limits_torque() const {
  return beta.size() != 0 && torque.array().isFinite().any();
}

double LimitShares::largest() const {
  const double share =
      std::max({position.maxCoeff(), speed.maxCoeff(), acceleration.maxCoeff(), torque.maxCoeff()});
  return distance < 0 ? std::max(share, 1 - distance) : share;
}

LimitShares limit_shares(const LinearModel& model, const MotionLimits& limits,
                         const JointMotion& motion) {
  LimitShares shares;
  shares.position =
      largest_shares(motion.q.rowwise() - middle(limits).transpose(), half_range(limits));
  shares.speed = largest_shares(motion.dq, limits.speed);
  shares.acceleration = largest_shares(motion.ddq, limits.acceleration);
  shares.torque = VectorXd::Zero(motion.q.cols());
  if (limits.limits_torque()) {
    shares.torque =
        largest_shares(model.torque(motion.q, motion.dq, motion.ddq, limits.beta), limits.torque);
  }
  shares.distance = std::numeric_limits<double>::infinity();
  if (limits.box) {
    for (Index k = 0; k < motion.q.rows(); ++k) {
      const ToolPoint tool = limits.box->tool(motion.q.row(k).transpose());
      shares.distance = std::min(shares.distance, distance_to(*limits.box, tool.position).value);
    }
  }
  return shares;
}

MotionConstraints constraints_of(const LinearModel& model, const MotionLimits& limits,
                                 const JointMotion& motion, double sharpness, double factor) {
  MotionConstraints constraints;
  add_joint_constraints(constraints, limits, motion, sharpness, factor);
  if (limits.limits_torque()) {
    add_torque_constraint(constraints, model, limits, motion, sharpness, factor);
  }
  if (limits.box) add_box_constraint(constraints, *limits.box, motion, sharpness, factor);
  return constraints;
}

}  // namespace dyngen::runtime
