// SPDX-License-Identifier: MIT
#include "runtime/consistency/consistency_prior.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "runtime/consistency/chi_places.h"
#include "runtime/consistency/pseudo_inertia.h"

namespace dyngen::runtime {
namespace {

/// Whether J, scaled to unit diagonal (so that units do not matter), is clear of singular.
bool is_well_inside(const Eigen::Matrix4d& J, double margin) {
  if ((J.diagonal().array() <= 0).any()) return false;
  const Eigen::Vector4d size = J.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::Matrix4d scaled = size.asDiagonal() * J * size.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(scaled, Eigen::EigenvaluesOnly)
             .eigenvalues()[0] > margin;
}

/// A ball about a centre of mass.
TenParameters ball(double mass, double radius, const Eigen::Vector3d& centre) {
  TenParameters ten = TenParameters::Zero();
  const Eigen::Matrix3d about =
      0.4 * mass * radius * radius * Eigen::Matrix3d::Identity() +
      mass * (centre.squaredNorm() * Eigen::Matrix3d::Identity() - centre * centre.transpose());
  ten << about(0, 0), about(0, 1), about(0, 2), about(1, 1), about(1, 2), about(2, 2),
      mass * centre, mass;
  return ten;
}

/// What a prior says of a body that it does not describe: its mass and its centre, if it has them.
TenParameters body_like(const TenParameters& ten, const ConsistencyOptions& options) {
  const double mass = ten[9];
  if (!(std::isfinite(mass) && mass > 0)) {
    return ball(options.default_mass, options.default_radius, Eigen::Vector3d::Zero());
  }
  const Eigen::Vector3d moments = ten.segment<3>(6);
  return ball(mass, options.default_radius,
              moments.allFinite() ? (moments / mass).eval() : Eigen::Vector3d::Zero());
}

}  // namespace

ConsistencyPrior complete_prior(const ConsistencyProblem& problem,
                                const ConsistencyOptions& options) {
  ConsistencyPrior prior;
  prior.chi = problem.prior;
  prior.scale = Eigen::VectorXd::Constant(problem.prior.size(), options.actuator_scale);
  std::vector<int> missing, inconsistent;
  std::vector<std::string> negative;
  for (int link = 0; link < problem.links; ++link) {
    const int first = kChiPerLink * link;
    TenParameters ten = problem.prior.segment<10>(first);
    const bool known = ten.allFinite();
    if (!known || !is_well_inside(pseudo_inertia(ten), options.prior_margin)) {
      (known ? inconsistent : missing).push_back(link + 1);
      ten = body_like(ten, options);
    }
    prior.chi.segment<10>(first) = ten;
    prior.factors.push_back(upper_factor(pseudo_inertia(ten)));
    for (int kind = kRotorInertiaPlace; kind <= kOffsetPlace; ++kind) {
      double& value = prior.chi[first + kind];
      if (!std::isfinite(value)) value = 0;
      if (is_nonnegative(kind) && value < 0) {
        negative.push_back(fmt::format(
            "{}{}", kActuatorNames[static_cast<std::size_t>(kind - kRotorInertiaPlace)], link + 1));
        value = 0;
      }
      if (value != 0) prior.scale[first + kind] = std::abs(value);
    }
  }
  const std::string ball_text =
      fmt::format("a ball of their mass ({:g} kg where there is none), radius {:g} m",
                  options.default_mass, options.default_radius);
  if (!missing.empty()) {
    prior.message +=
        fmt::format("Links {}: not all ten parameters have a prior; {} stands for it.\n",
                    fmt::join(missing, ", "), ball_text);
  }
  if (!inconsistent.empty()) {
    prior.message += fmt::format("Links {}: the prior is of no physical body; {} stands for it.\n",
                                 fmt::join(inconsistent, ", "), ball_text);
  }
  if (!negative.empty()) {
    prior.message +=
        fmt::format("The prior of {} is negative; 0 stands for it.\n", fmt::join(negative, ", "));
  }
  return prior;
}

}  // namespace dyngen::runtime
