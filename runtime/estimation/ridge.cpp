// SPDX-License-Identifier: MIT
#include "runtime/estimation/ridge.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "runtime/estimation/covariance.h"
#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void check(const TorqueFactor& factor, const Prior& prior, double lambda) {
  if (prior.beta.size() != factor.parameters || prior.stddev.size() != factor.parameters) {
    throw std::invalid_argument(
        fmt::format("ridge(): a prior of {} values and {} deviations, "
                    "expected {}",
                    prior.beta.size(), prior.stddev.size(), factor.parameters));
  }
  if (!(prior.stddev.array() > 0).all() || !(lambda >= 0)) {
    throw std::invalid_argument(
        "ridge(): expected positive standard deviations of the prior and lambda >= 0");
  }
}

}  // namespace

Prior make_prior(const TorqueFactor& factor, const VectorXd& joint_weights, const VectorXd& beta,
                 double relative) {
  constexpr double kSmallPart =
      0.02;  // of the torque: a parameter this small has no value to trust
  const VectorXd norms = column_norms(factor, joint_weights);
  const double torque = std::sqrt(torque_squares(factor).dot(joint_weights.cwiseAbs2().eval()));
  Prior prior{beta, VectorXd(beta.size())};
  for (Index i = 0; i < beta.size(); ++i) {
    const double small = norms[i] > 0 ? kSmallPart * torque / norms[i] : 1;
    prior.stddev[i] = relative * std::max(std::abs(beta[i]), small);
    if (!(prior.stddev[i] > 0)) prior.stddev[i] = relative;
  }
  return prior;
}

Estimate ridge(const TorqueFactor& factor, const VectorXd& joint_weights, const Prior& prior,
               double lambda) {
  check(factor, prior, lambda);
  Estimate estimate = least_squares(factor, joint_weights);  // for its condition and rank
  const StackedRows rows = stacked(factor, joint_weights);
  const Index m = rows.W.rows(), nb = rows.W.cols();
  MatrixXd A(m + nb, nb);
  A << rows.W * prior.stddev.asDiagonal(), lambda * MatrixXd::Identity(nb, nb);
  VectorXd b(m + nb);
  b << rows.tau - rows.W * prior.beta, VectorXd::Zero(nb);
  estimate.beta = prior.beta + prior.stddev.cwiseProduct(least_norm_solution(A, b).col(0));
  if (lambda > 0) {  // the prior says what the data do not
    estimate.unseen = MatrixXd::Zero(nb, 0);
  }
  const VectorXd squares = residual_squares(factor, estimate.beta);
  for (Index j = 0; j < squares.size(); ++j) {
    const double count = factor.joints[static_cast<std::size_t>(j)].rows;
    estimate.residual_rms[j] = count > 0 ? std::sqrt(squares[j] / count) : 0;
  }
  return estimate;
}

MatrixXd ridge_covariance(const TorqueFactor& factor, const NoiseFactor& noise,
                          const VectorXd& joint_weights, const Prior& prior, double lambda) {
  check(factor, prior, lambda);
  // all in multiples of the prior's deviations
  const MatrixXd W = stacked(factor, joint_weights).W * prior.stddev.asDiagonal();
  const MatrixXd F = noise_rows(noise, factor.columns, factor.parameters, joint_weights) *
                     prior.stddev.asDiagonal();
  MatrixXd information = W.transpose() * W, middle = F.transpose() * F;
  information.diagonal().array() += std::pow(lambda, 2);
  middle.diagonal().array() += std::pow(lambda, 4);
  const MatrixXd L = prior.stddev.asDiagonal() * pseudo_inverse(information);
  return L * middle * L.transpose();
}

std::vector<LCurvePoint> l_curve(const TorqueFactor& factor, const VectorXd& joint_weights,
                                 const Prior& prior, int points) {
  std::vector<LCurvePoint> curve;
  for (int i = 0; i < points; ++i) {
    const double lambda = std::pow(10.0, -4 + 8.0 * i / (points - 1));
    const Estimate fit = ridge(factor, joint_weights, prior, lambda);
    const double residual =
        std::sqrt(residual_squares(factor, fit.beta).dot(joint_weights.cwiseAbs2().eval()));
    curve.push_back({lambda, residual, (fit.beta - prior.beta).cwiseQuotient(prior.stddev).norm()});
  }
  return curve;
}

double corner(const std::vector<LCurvePoint>& curve) {
  double best = 0, lambda = curve.empty() ? 0 : curve.front().lambda;
  for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
    const auto x = [&](std::size_t k) { return std::log(std::max(curve[k].residual, 1e-300)); };
    const auto y = [&](std::size_t k) { return std::log(std::max(curve[k].deviation, 1e-300)); };
    const double dx = 0.5 * (x(i + 1) - x(i - 1)), dy = 0.5 * (y(i + 1) - y(i - 1));
    const double ddx = x(i + 1) - 2 * x(i) + x(i - 1), ddy = y(i + 1) - 2 * y(i) + y(i - 1);
    const double speed = dx * dx + dy * dy;
    if (speed < 1e-12) continue;
    const double bend = (dx * ddy - dy * ddx) / std::pow(speed, 1.5);
    if (bend > best) {
      best = bend;
      lambda = curve[i].lambda;
    }
  }
  return lambda;
}

}  // namespace dyngen::runtime
