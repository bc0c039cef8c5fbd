// SPDX-License-Identifier: MIT
#include "runtime/consistency/linearised_cost.h"

#include <cmath>
#include <cstddef>

#include "runtime/consistency/log_cholesky_map.h"

namespace dyngen::runtime {
namespace {

/// Weights of the ten elements, where those off the diagonal stand for two.
Eigen::Matrix<double, 10, 1> roots_of(double factor) {
  const Eigen::Matrix4d twice = Eigen::Matrix4d::Constant(2);
  return log_cholesky_map::upper_elements<double>(
             Eigen::Matrix4d(factor * (twice - Eigen::Matrix4d::Identity())))
      .cwiseSqrt();
}

}  // namespace

LinearisedCost linearise_data(const ConsistencyCost& cost, const ScaledParameters& at,
                              Eigen::Index rows) {
  const Eigen::Index nb = cost.A.rows();
  LinearisedCost step{Eigen::MatrixXd::Zero(rows, cost.A.cols()), Eigen::VectorXd::Zero(rows)};
  step.rows.topRows(nb) = cost.A;
  step.residual.head(nb) = cost.A * stacked(at) - cost.b;
  return step;
}

Eigen::Matrix<double, 10, 1> cone_residual(double factor, const Eigen::Matrix4d& gradient) {
  return roots_of(factor).cwiseProduct(log_cholesky_map::upper_elements<double>(gradient));
}

void write_cone_rows(LinearisedCost& step, Eigen::Index first, int link, double factor,
                     const Eigen::Matrix4d& inverse, const Eigen::Matrix4d& gradient) {
  for (int element = 0; element < 10; ++element) {
    const Eigen::Matrix4d unit =
        log_cholesky_map::from_upper_elements<double>(Eigen::Matrix<double, 10, 1>::Unit(element));
    step.rows.block<10, 1>(first, 10 * link + element) =
        cone_residual(factor, inverse * unit * inverse.transpose());
  }
  step.residual.segment<10>(first) = cone_residual(factor, gradient);
}

void write_actuator_rows(LinearisedCost& step, Eigen::Index first, const ConsistencyCost& cost,
                         const ScaledParameters& at) {
  const Eigen::Index na = cost.actuators();
  step.rows.block(first, cost.inertial_size(), na, na)
      .diagonal()
      .setConstant(std::sqrt(cost.weight));
  step.residual.segment(first, na) = std::sqrt(cost.weight) * (at.actuators - cost.prior);
}

ScaledParameters moved(const ScaledParameters& from, const Eigen::VectorXd& dx, double t) {
  ScaledParameters to = from;
  for (std::size_t link = 0; link < to.S.size(); ++link) {
    to.S[link] += t * log_cholesky_map::from_upper_elements<double>(
                          dx.segment<10>(static_cast<Eigen::Index>(10 * link)));
  }
  to.actuators += t * dx.tail(to.actuators.size());
  return to;
}

}  // namespace dyngen::runtime
