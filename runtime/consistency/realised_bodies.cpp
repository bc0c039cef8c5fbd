// SPDX-License-Identifier: MIT
#include "runtime/consistency/realised_bodies.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

#include "runtime/consistency/chi_places.h"
#include "runtime/consistency/consistency_cost.h"
#include "runtime/consistency/linearised_cost.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of Newton: some ten where bodies are like their priors, some hundreds where a body is thinner
/// than its prior by 1e4. A step of five bodies takes 0.1 ms.
constexpr int kMostRealisationSteps = 5000;
/// Newton's decrement, below which its steps are taken whole: it shrinks as its square from there
/// on (Boyd and Vandenberghe 2004, section 9.6.4).
constexpr double kWholeSteps = 0.25;
/// Of the way to the edge of the cone, for a step along the path: far enough for few steps, near
/// enough for few corrections after it.
constexpr double kOfTheWayToTheEdge = 0.7;
/// Of the prior's in every direction: a body that is thinner than this is none.
constexpr double kThinnestBody = 1e-10;
/// Of the equations, in units of what they sum up: some thousand times the rounding of a double.
constexpr double kEquationsHold = 1e-12;
/// Square of Newton's decrement, without unit: bodies change by some 1e-5 of themselves after it.
constexpr double kNearestEnough = 1e-10;

void check_sizes(const RealisationProblem& problem) {
  const Index unknowns = 10 * static_cast<Index>(problem.bodies);
  if (problem.bodies < 1 || problem.K.cols() != unknowns || problem.prior.size() != unknowns ||
      problem.K.rows() != problem.beta.size()) {
    throw std::invalid_argument("realise_bodies(): the sizes do not fit together");
  }
  if (!problem.K.allFinite() || !problem.beta.allFinite()) {
    throw std::invalid_argument("realise_bodies(): a number is not finite");
  }
}

/// The same unknowns as a ConsistencyCost, whose places of actuators are empty.
ConsistencyCost cost_of_bodies(const RealisationProblem& problem, std::string& message) {
  const Index places = static_cast<Index>(kChiPerLink) * problem.bodies;
  ConsistencyProblem consistency;
  consistency.links = problem.bodies;
  consistency.K = MatrixXd::Zero(problem.K.rows(), places);
  consistency.prior = VectorXd::Zero(places);
  for (int body = 0; body < problem.bodies; ++body) {
    consistency.K.middleCols<kTenCount>(kChiPerLink * body) =
        problem.K.middleCols<kTenCount>(kTenCount * body);
    consistency.prior.segment<kTenCount>(kChiPerLink * body) =
        problem.prior.segment<kTenCount>(kTenCount * body);
  }
  consistency.R = MatrixXd::Identity(problem.K.rows(), problem.K.rows());
  consistency.z = problem.beta;
  consistency.free.assign(static_cast<std::size_t>(places), false);
  ConsistencyPrior prior = complete_prior(consistency, {});
  message = prior.message;
  return make_cost(consistency, std::move(prior));
}

/// The least of a body in units of the prior's, in the direction where it is least.
double thinnest(const ScaledParameters& at) {
  double least = std::numeric_limits<double>::infinity();
  for (const Eigen::Matrix4d& S : at.S) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(S, Eigen::EigenvaluesOnly);
    least = std::min(least, solver.eigenvalues()[0]);
  }
  return least;
}

/// Newton's step towards the nearest bodies of a point of the path, and along the path.
struct PathStep {
  VectorXd correction, correction_rows;  ///< dx, and H^1/2 dx
  VectorXd advance;                      ///< for the whole of what is left of the path
};

/// min ||V^-1 dS V^-T + V'V - 1||^2 / 2 over bodies, subject to A dx = what this point lacks, and
/// what further equations change of dx.
/// @param lacks    (nb) of A x at this point of the path
/// @param further  (nb) that A x changes by to the end of the path
PathStep path_step(const ConsistencyCost& cost, const ScaledParameters& at, const VectorXd& lacks,
                   const VectorXd& further) {
  const Index unknowns = cost.inertial_size();
  LinearisedCost model{MatrixXd::Zero(unknowns, unknowns), VectorXd::Zero(unknowns)};
  MatrixXd inverse = MatrixXd::Zero(unknowns, unknowns);
  for (int body = 0; body < cost.links; ++body) {
    const Eigen::Matrix4d V = at.S[static_cast<std::size_t>(body)].llt().matrixL();
    write_cone_rows(model, 10 * body, body, 0.5,
                    V.triangularView<Eigen::Lower>().solve(Eigen::Matrix4d::Identity()),
                    V.transpose() * V - Eigen::Matrix4d::Identity());
    const Eigen::Matrix<double, 10, 10> block = model.rows.block<10, 10>(10 * body, 10 * body);
    inverse.block<10, 10>(10 * body, 10 * body) = block.inverse();
  }
  // y = rows dx + residual is the unknown: the shortest y that fulfils the equations
  const MatrixXd equations = cost.A * inverse;
  const Eigen::CompleteOrthogonalDecomposition<MatrixXd> shortest(equations);
  PathStep step;
  step.correction_rows = shortest.solve(lacks + equations * model.residual) - model.residual;
  step.correction = inverse * step.correction_rows;
  step.advance = inverse * shortest.solve(further);
  return step;
}

/// How far a step may go before a body ceases to exist: the largest t with S + t dS >= 0.
double way_to_the_edge(const ScaledParameters& at, const VectorXd& dx) {
  double way = std::numeric_limits<double>::infinity();
  const ScaledParameters to = moved(at, dx, 1);
  for (std::size_t body = 0; body < at.S.size(); ++body) {
    const Eigen::Matrix4d change = to.S[body] - at.S[body];
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix4d> solver(change, at.S[body],
                                                                           Eigen::EigenvaluesOnly);
    if (solver.eigenvalues()[0] < 0) way = std::min(way, -1 / solver.eigenvalues()[0]);
  }
  return way;
}

double equation_error(const ConsistencyCost& cost, const ScaledParameters& at,
                      const VectorXd& sizes) {
  return (cost.A * stacked(at) - cost.b).cwiseQuotient(sizes).lpNorm<Eigen::Infinity>();
}

/// What each equation sums up, at the prior or in beta: never 0.
VectorXd equation_sizes(const ConsistencyCost& cost) {
  VectorXd sizes = cost.A.cwiseAbs().rowwise().sum().cwiseMax(cost.b.cwiseAbs());
  return (sizes.array() > 0).select(sizes, 1);
}

}  // namespace

RealisedBodies realise_bodies(const RealisationProblem& problem) {
  check_sizes(problem);
  RealisedBodies result;
  ConsistencyCost cost = cost_of_bodies(problem, result.message);
  const VectorXd sizes = equation_sizes(cost);
  // rows of like size: the decomposition decides by size what is dependent
  cost.A = sizes.cwiseInverse().asDiagonal() * cost.A;
  cost.b = cost.b.cwiseQuotient(sizes);
  const VectorXd ones = VectorXd::Ones(sizes.size());
  ScaledParameters at = at_prior(cost);
  const VectorXd way = cost.b - cost.A * stacked(at);  // of the equations, all the path long
  double left = 1;                                     // of the path
  for (int k = 0; k < kMostRealisationSteps && thinnest(at) > kThinnestBody; ++k) {
    const VectorXd lacks = cost.b - left * way - cost.A * stacked(at);
    const PathStep step = path_step(cost, at, lacks, left * way);
    if (!step.correction.allFinite() || !step.advance.allFinite()) break;
    const double decrement = step.correction_rows.norm();
    if (decrement > kWholeSteps) {
      at = moved(at, step.correction, 1 / (1 + decrement));
      continue;
    }
    at = moved(at, step.correction, 1);
    if (left > 0) {
      const double part = std::min(1.0, kOfTheWayToTheEdge * way_to_the_edge(at, step.advance));
      at = moved(at, step.advance, part);
      left = part == 1 ? 0 : left * (1 - part);
    } else if (decrement * decrement < kNearestEnough &&
               equation_error(cost, at, ones) < kEquationsHold) {
      result.exact = true;
      break;
    }
  }
  result.residual = equation_error(cost, at, ones);
  result.prior_distance = prior_distance(cost, at);
  const VectorXd chi = to_chi(cost, at);
  result.ten.resize(problem.prior.size());
  for (int body = 0; body < problem.bodies; ++body) {
    result.ten.segment<kTenCount>(kTenCount * body) = chi.segment<kTenCount>(kChiPerLink * body);
  }
  return result;
}

}  // namespace dyngen::runtime
