// SPDX-License-Identifier: MIT
#include "runtime/excitation/information.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The parameters of interest that act on one joint.
struct ColumnsOfJoint {
  std::vector<Index> rows_of_R;
  std::vector<Index> columns_of_Y;
};

std::vector<int> asked_parameters(const LinearModel& model, const std::vector<int>& parameters) {
  if (!parameters.empty()) return parameters;
  std::vector<int> all(static_cast<std::size_t>(model.size()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

std::vector<ColumnsOfJoint> joint_columns(const LinearModel& model,
                                          const std::vector<int>& parameters) {
  std::vector<Index> place(static_cast<std::size_t>(model.size()), -1);
  const std::vector<int> asked = asked_parameters(model, parameters);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    place[static_cast<std::size_t>(asked[i])] = static_cast<Index>(i);
  }
  std::vector<ColumnsOfJoint> joints;
  for (int j = 0; j < model.joints(); ++j) {
    ColumnsOfJoint own;
    for (const int column : model.columns[static_cast<std::size_t>(j)]) {
      if (place[static_cast<std::size_t>(column)] < 0) continue;
      own.rows_of_R.push_back(place[static_cast<std::size_t>(column)]);
      own.columns_of_Y.push_back(Index{j} * model.size() + column);
    }
    joints.push_back(std::move(own));
  }
  return joints;
}

/// 1 / sigma^2 of a joint, times what the motion's samples are taken for.
double weight_of(const InformationOptions& options, Index joint, Index samples) {
  const double sigma = options.torque_noise.size() == 0 ? 1 : options.torque_noise[joint];
  const double recorded = options.samples > 0 ? options.samples : static_cast<double>(samples);
  return recorded / static_cast<double>(samples) / (sigma * sigma);
}

}  // namespace

void InformationOptions::validate(const LinearModel& model) const {
  if (torque_noise.size() != 0 && torque_noise.size() != model.joints()) {
    throw std::invalid_argument(
        fmt::format("torque noise: {} values, expected one for each of {} joints",
                    torque_noise.size(), model.joints()));
  }
  if (torque_noise.size() != 0 && !(torque_noise.minCoeff() > 0)) {
    throw std::invalid_argument(
        fmt::format("torque noise: {}, expected more than 0", torque_noise.minCoeff()));
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i] < 0 || parameters[i] >= model.size() ||
        (i > 0 && parameters[i] <= parameters[i - 1])) {
      throw std::invalid_argument(fmt::format(
          "parameters: found {}, expected ascending places below {}", parameters[i], model.size()));
    }
  }
  const Index size = static_cast<Index>(asked_parameters(model, parameters).size());
  if (prior.size() != 0 && (prior.rows() != size || prior.cols() != size)) {
    throw std::invalid_argument(fmt::format("prior information: {} x {}, expected {} x {}",
                                            prior.rows(), prior.cols(), size, size));
  }
}

Information information_of(const LinearModel& model, const JointMotion& motion,
                           const InformationOptions& options) {
  options.validate(model);
  Information information;
  model.regressor(motion.q, motion.dq, motion.ddq, information.Y);
  const Index size = static_cast<Index>(asked_parameters(model, options.parameters).size());
  MatrixXd& R = information.R;
  R = options.prior.size() == 0 ? MatrixXd::Zero(size, size) : options.prior;
  const std::vector<ColumnsOfJoint> joints = joint_columns(model, options.parameters);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const MatrixXd Yj = information.Y(Eigen::all, joints[j].columns_of_Y);
    MatrixXd square = MatrixXd::Zero(Yj.cols(), Yj.cols());
    square.selfadjointView<Eigen::Lower>().rankUpdate(Yj.transpose());
    R(joints[j].rows_of_R, joints[j].rows_of_R) +=
        weight_of(options, static_cast<Index>(j), motion.q.rows()) *
        MatrixXd(square.selfadjointView<Eigen::Lower>());
  }
  return information;
}

JointMotion information_gradient(const LinearModel& model, const JointMotion& motion,
                                 const InformationOptions& options, const Information& information,
                                 const MatrixXd& G) {
  if (!model.regressor_gradient) {
    throw std::invalid_argument("information_gradient(): the model has no regressor_gradient");
  }
  MatrixXd A = MatrixXd::Zero(information.Y.rows(), information.Y.cols());
  const std::vector<ColumnsOfJoint> joints = joint_columns(model, options.parameters);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const double weight = weight_of(options, static_cast<Index>(j), motion.q.rows());
    const MatrixXd own = G(joints[j].rows_of_R, joints[j].rows_of_R);
    const MatrixXd Yj = information.Y(Eigen::all, joints[j].columns_of_Y);
    A(Eigen::all, joints[j].columns_of_Y) = 2 * weight * (Yj * own);
  }
  return model.regressor_gradient(motion, A);
}

double condition_number(const LinearModel& model, const JointMotion& motion,
                        const std::vector<int>& parameters, bool unit_columns) {
  MatrixXd Y;
  model.regressor(motion.q, motion.dq, motion.ddq, Y);
  const std::vector<ColumnsOfJoint> joints = joint_columns(model, parameters);
  const Index size = static_cast<Index>(asked_parameters(model, parameters).size());
  MatrixXd W = MatrixXd::Zero(motion.q.rows() * model.joints(), size);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    W.middleRows(static_cast<Index>(j) * motion.q.rows(), motion.q.rows())(
        Eigen::all, joints[j].rows_of_R) = Y(Eigen::all, joints[j].columns_of_Y);
  }
  if (unit_columns) {
    for (Index c = 0; c < size; ++c) {
      const double norm = W.col(c).norm();
      if (norm > 0) W.col(c) /= norm;
    }
  }
  const VectorXd values = singular_values(triangle_in_place(W));
  return values[size - 1] > 0 ? values[0] / values[size - 1]
                              : std::numeric_limits<double>::infinity();
}

VectorXd standard_deviations(const MatrixXd& R) {
  // with unit columns, so that units do not decide what is rank
  const VectorXd scale = R.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(scale.asDiagonal() * R * scale.asDiagonal());
  const double smallest = 1e-14 * solver.eigenvalues().tail(1)[0];
  VectorXd variance = VectorXd::Zero(R.rows());
  for (Index i = 0; i < R.rows(); ++i) {
    const VectorXd squares = solver.eigenvectors().col(i).cwiseAbs2();
    const double value = solver.eigenvalues()[i];
    for (Index c = 0; c < R.rows(); ++c) {
      if (value > smallest) {
        variance[c] += squares[c] / value;
      } else if (squares[c] > 1e-8) {
        variance[c] = std::numeric_limits<double>::infinity();
      }
    }
  }
  return variance.cwiseSqrt().cwiseProduct(scale);
}

}  // namespace dyngen::runtime
