// SPDX-License-Identifier: MIT
#include "runtime/consistency/consistent_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/SVD>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/consistency/chi_places.h"
#include "runtime/consistency/consistency_cost.h"
#include "runtime/consistency/consistency_path.h"
#include "runtime/consistency/log_cholesky_fit.h"
#include "runtime/consistency/pseudo_inertia.h"
#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

/// Standard deviations of data by which they must push an actuator against 0 to be said to want it
/// negative: less may be the prior's doing.
constexpr double kPush = 0.01;

void require(bool fine, const std::string& message) {
  if (!fine) throw std::invalid_argument("fit_consistent(): " + message);
}

void validate(const ConsistencyProblem& problem) {
  require(problem.links >= 1, fmt::format("links is {}, expected 1 or more", problem.links));
  const Eigen::Index nb = problem.K.rows(), chi = kChiPerLink * problem.links;
  require(nb >= 1 && problem.K.cols() == chi,
          fmt::format("K is {} x {}, expected {} columns (= 14 x {} links) and a row or more", nb,
                      problem.K.cols(), chi, problem.links));
  require(problem.R.rows() == nb && problem.R.cols() == nb,
          fmt::format("R is {} x {}, expected {} x {}, a column for each row of K",
                      problem.R.rows(), problem.R.cols(), nb, nb));
  require(problem.z.size() == nb,
          fmt::format("z has {} rows, R has {}", problem.z.size(), problem.R.rows()));
  require(problem.prior.size() == chi,
          fmt::format("prior has {} entries, expected {} (NaN where there is none)",
                      problem.prior.size(), chi));
  require(problem.free.size() == static_cast<std::size_t>(chi),
          fmt::format("free has {} entries, expected {}", problem.free.size(), chi));
  require(problem.K.allFinite() && problem.R.allFinite() && problem.z.allFinite(),
          "K, R or z is not finite");
  require(std::isfinite(problem.prior_weight) && problem.prior_weight > 0,
          fmt::format("prior_weight is {}, expected more than 0", problem.prior_weight));
}

/// What the data say of beta alone.
struct FreeSolution {
  Eigen::VectorXd beta, stddev;  ///< stddev infinite where R does not determine
  double cost = 0;
  Eigen::Index rank = 0;
};

FreeSolution solve_free(const Eigen::MatrixXd& R, const Eigen::VectorXd& z) {
  const Eigen::VectorXd scale = unit_scale(R);
  const Eigen::MatrixXd scaled = R * scale.asDiagonal();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
  FreeSolution result;
  result.rank = svd.rank();
  result.beta = scale.cwiseProduct(svd.solve(z));
  result.cost = (R * result.beta - z).squaredNorm();
  const Eigen::Index known = result.rank, unknown = R.cols() - known;
  const Eigen::VectorXd inverse = svd.singularValues().head(known).cwiseInverse();
  result.stddev = (svd.matrixV().leftCols(known) * inverse.asDiagonal()).rowwise().norm();
  result.stddev = result.stddev.cwiseProduct(scale);
  if (unknown > 0) {
    const Eigen::VectorXd share = svd.matrixV().rightCols(unknown).rowwise().norm();
    for (Eigen::Index k = 0; k < share.size(); ++k) {
      if (share[k] > 1e-8) result.stddev[k] = std::numeric_limits<double>::infinity();
    }
  }
  return result;
}

struct Search {
  ScaledParameters parameters;
  std::vector<bool> at_zero;
  bool converged = false;
  std::string message;
};

Search search(const ConsistencyCost& cost, const ConsistencyOptions& options) {
  ScaledParameters start = at_prior(cost);
  if (options.search == ConsistencySearch::kCentralPath) {
    NewtonResult path = follow_path(cost);
    if (path.converged) return {path.parameters, path.at_zero, true, ""};
    if (std::isfinite(prior_distance(cost, path.parameters))) start = path.parameters;
  }
  const LogCholeskyFit fit = fit_log_cholesky(cost, options, start);
  Search result{fit.parameters, fit.at_zero, fit.converged, ""};
  if (!fit.at_floor.empty()) {
    result.message = fmt::format("Links {}: at the edge of consistency, held there by `floor`.\n",
                                 fmt::join(fit.at_floor, ", "));
  }
  if (!fit.converged) result.message += fmt::format("No convergence: {}\n", fit.message);
  return result;
}

}  // namespace

void ConsistencyOptions::validate() const {
  const auto positive = [](double value, const char* name) {
    if (!(std::isfinite(value) && value > 0)) {
      throw std::invalid_argument(
          fmt::format("ConsistencyOptions: {} is {}, expected more than 0", name, value));
    }
  };
  positive(default_mass, "default_mass");
  positive(default_radius, "default_radius");
  positive(actuator_scale, "actuator_scale");
  positive(floor, "floor");
  positive(max_iterations, "max_iterations");
  if (!(floor < 1)) {
    throw std::invalid_argument(
        fmt::format("ConsistencyOptions: floor is {}, expected less than 1", floor));
  }
  if (!(prior_margin >= 0 && prior_margin < 1)) {
    throw std::invalid_argument(
        fmt::format("ConsistencyOptions: prior_margin is {}, expected 0 <= it < 1", prior_margin));
  }
}

ConsistentEstimate fit_consistent(const ConsistencyProblem& problem,
                                  const ConsistencyOptions& options) {
  validate(problem);
  options.validate();
  const ConsistencyCost cost = make_cost(problem, complete_prior(problem, options));
  ConsistentEstimate result;
  result.message = cost.full.message;

  const Search found = search(cost, options);
  result.chi = to_chi(cost, found.parameters);
  result.beta = problem.K * result.chi;
  result.cost = (problem.R * result.beta - problem.z).squaredNorm();
  result.prior_distance = prior_distance(cost, found.parameters);
  result.converged = found.converged;
  result.smallest_eigenvalue.resize(problem.links);
  for (int link = 0; link < problem.links; ++link) {
    result.smallest_eigenvalue[link] =
        smallest_eigenvalue(result.chi.segment<kTenCount>(kChiPerLink * link));
  }
  result.at_bound.assign(static_cast<std::size_t>(result.chi.size()), false);
  std::vector<std::string> at_zero;
  const Eigen::VectorXd residual = cost.A * stacked(found.parameters) - cost.b;
  for (int k = 0; k < cost.actuators(); ++k) {
    const auto place = static_cast<std::size_t>(cost.places[static_cast<std::size_t>(k)]);
    const auto column = cost.A.col(cost.inertial_size() + k);
    const bool pushed = column.dot(residual) > kPush * column.norm();
    if (!found.at_zero[static_cast<std::size_t>(k)] || !pushed) continue;
    result.at_bound[place] = true;
    at_zero.push_back(fmt::format("{}{}", kActuatorNames[place % kChiPerLink - kRotorInertiaPlace],
                                  place / kChiPerLink + 1));
  }

  const FreeSolution free = solve_free(problem.R, problem.z);
  result.cost_free = free.cost;
  result.pull = (result.beta - free.beta).cwiseQuotient(free.stddev);

  if (!at_zero.empty()) {
    result.message +=
        fmt::format("At 0, the data want them negative: {}.\n", fmt::join(at_zero, ", "));
  }
  if (free.rank < problem.R.cols()) {
    result.message +=
        fmt::format("The data determine {} of {} base parameters; the prior decides the rest.\n",
                    free.rank, problem.R.cols());
  }
  if (!(result.smallest_eigenvalue.minCoeff() > 0)) {
    result.converged = false;
    result.message +=
        "A pseudo-inertia is singular to rounding; a prior_weight above this helps.\n";
  }
  result.message += found.message;
  return result;
}

}  // namespace dyngen::runtime
