// SPDX-License-Identifier: MIT
#include "runtime/identification/hierarchy.h"

#include <fmt/format.h>

#include <stdexcept>

#include "runtime/estimation/covariance.h"
#include "runtime/estimation/decompositions.h"
#include "runtime/estimation/least_squares.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSeenPart = 1e-9;  // of the strongest direction

bool is_own(ParameterKind kind) {
  return kind == ParameterKind::kViscous || kind == ParameterKind::kCoulomb ||
         kind == ParameterKind::kOffset;
}

/// A robot's equations after its own parameters were eliminated:
/// [own shared tau] = Q [R_own R_mixed z_own; 0 R_shared z_shared].
struct Eliminated {
  MatrixXd own, mixed, shared;
  VectorXd own_tau, shared_tau;
  MatrixXd projection;  ///< own^-1 mixed
  MatrixXd own_inverse;
};

Eliminated eliminate(const TorqueFactor& factor, const VectorXd& weights, const HierarchyFit& fit) {
  const StackedRows rows = stacked(factor, weights);
  const Index own = static_cast<Index>(fit.own.size()),
              shared = static_cast<Index>(fit.shared.size());
  MatrixXd all(rows.W.rows(), own + shared + 1);
  all << rows.W(Eigen::all, fit.own), rows.W(Eigen::all, fit.shared), rows.tau;
  const MatrixXd R = triangle_in_place(all);
  Eliminated parts;
  parts.own = R.topLeftCorner(own, own);
  parts.mixed = R.block(0, own, own, shared);
  parts.own_tau = R.col(own + shared).head(own);
  parts.shared = R.block(own, own, shared, shared);
  parts.shared_tau = R.col(own + shared).segment(own, shared);
  // friction of a joint that never moved is not seen: zero, and no deviation
  parts.own_inverse = pseudo_inverse(parts.own);
  parts.projection = parts.own_inverse * parts.mixed;
  return parts;
}

}  // namespace

VectorXd HierarchyFit::Robot::beta(const HierarchyFit& fit) const {
  VectorXd all(static_cast<Index>(fit.shared.size() + fit.own.size()));
  all(fit.shared) = fit.shared_beta;
  all(fit.own) = own_beta;
  return all;
}

HierarchyFit fit_own_friction(const LinearModel& model, const RobotSummaries& all,
                              VectorXd weights) {
  if (all.robots.empty()) throw std::invalid_argument("fit_own_friction(): there is no robot");
  HierarchyFit fit;
  for (int i = 0; i < model.size(); ++i) {
    (is_own(model.parameters[static_cast<std::size_t>(i)].kind) ? fit.own : fit.shared)
        .push_back(i);
  }
  if (fit.own.empty() || fit.shared.empty()) {
    throw std::invalid_argument(
        fmt::format("{} has {} parameters of friction and {} others: robots that share inertia and "
                    "keep their friction need both",
                    model.name, fit.own.size(), fit.shared.size()));
  }
  if (weights.size() == 0) weights = weighted_least_squares(pooled(all).equations).joint_weights;
  const Index shared = static_cast<Index>(fit.shared.size());

  MatrixXd sum = MatrixXd::Zero(shared, shared + 1);
  MatrixXd middle = MatrixXd::Zero(shared, shared);
  std::vector<Eliminated> parts;
  for (const auto& [name, summary] : all.robots) {
    parts.push_back(eliminate(summary.equations, weights, fit));
    MatrixXd stack(2 * shared, shared + 1);
    stack << sum, parts.back().shared, parts.back().shared_tau;
    sum = triangle_in_place(stack).topRows(shared);
    const MatrixXd noise =
        noise_rows(summary.noise, summary.equations.columns, model.size(), weights);
    const MatrixXd left =
        noise(Eigen::all, fit.shared) - noise(Eigen::all, fit.own) * parts.back().projection;
    middle += left.transpose() * left;
  }
  const MatrixXd R = sum.leftCols(shared);
  const VectorXd singular = singular_values(R);
  fit.rank = static_cast<int>((singular.array() > kSeenPart * singular[0]).count());
  fit.shared_beta = least_norm_solution(R, sum.col(shared), kSeenPart);
  const MatrixXd inverse = pseudo_inverse(R, kSeenPart);
  const MatrixXd information = inverse * inverse.transpose();
  const MatrixXd covariance = information * middle * information;
  fit.shared_stddev = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();

  std::size_t next = 0;
  for (const auto& [name, summary] : all.robots) {
    const Eliminated& part = parts[next++];
    HierarchyFit::Robot robot;
    robot.name = name;
    robot.own_beta = part.own_inverse * (part.own_tau - part.mixed * fit.shared_beta);
    const MatrixXd rows =
        noise_rows(summary.noise, summary.equations.columns, model.size(), weights);
    const MatrixXd noise =
        rows(Eigen::all, fit.own) * (part.own_inverse * part.own_inverse.transpose());
    const MatrixXd own =
        noise.transpose() * noise + part.projection * covariance * part.projection.transpose();
    robot.own_stddev = own.diagonal().cwiseMax(0.0).cwiseSqrt();
    const VectorXd squares = residual_squares(summary.equations, robot.beta(fit));
    robot.percent =
        100 * (squares.array() / torque_squares(summary.equations).array().max(1e-300)).sqrt();
    fit.robots.push_back(std::move(robot));
  }
  return fit;
}

}  // namespace dyngen::runtime
