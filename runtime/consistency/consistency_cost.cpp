// SPDX-License-Identifier: MIT
#include "runtime/consistency/consistency_cost.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "runtime/consistency/chi_places.h"
#include "runtime/consistency/log_cholesky_map.h"
#include "runtime/consistency/pseudo_inertia.h"

namespace dyngen::runtime {
namespace {

Eigen::Matrix4d pseudo_inertia_of(const Eigen::Matrix4d& U0, const Eigen::Matrix4d& S) {
  return U0 * S * U0.transpose();
}

}  // namespace

ConsistencyCost make_cost(const ConsistencyProblem& problem, ConsistencyPrior prior) {
  ConsistencyCost cost;
  cost.links = problem.links;
  cost.weight = problem.prior_weight;
  const Eigen::MatrixXd RK = problem.R * problem.K;
  Eigen::VectorXd fixed = prior.chi;
  for (int place = 0; place < fixed.size(); ++place) {
    const int kind = place % kChiPerLink;
    if (kind < kTenCount) {
      fixed[place] = 0;
    } else if (problem.free[static_cast<std::size_t>(place)]) {
      fixed[place] = 0;
      cost.places.push_back(place);
      cost.nonnegative.push_back(is_nonnegative(kind));
    }
  }
  cost.b = problem.z - RK * fixed;
  cost.A.resize(RK.rows(), cost.inertial_size() + cost.actuators());
  for (int link = 0; link < cost.links; ++link) {
    // chi is linear in S: its columns are the images of the unit matrices.
    Eigen::Matrix<double, 10, 10> ten_of_S;
    for (int element = 0; element < 10; ++element) {
      const Eigen::Matrix4d unit = log_cholesky_map::from_upper_elements<double>(
          Eigen::Matrix<double, 10, 1>::Unit(element));
      ten_of_S.col(element) =
          ten_parameters(pseudo_inertia_of(prior.factors[static_cast<std::size_t>(link)], unit));
    }
    cost.A.middleCols<10>(10 * link) = RK.middleCols<10>(kChiPerLink * link) * ten_of_S;
  }
  cost.prior.resize(cost.actuators());
  for (int k = 0; k < cost.actuators(); ++k) {
    const int place = cost.places[static_cast<std::size_t>(k)];
    cost.A.col(cost.inertial_size() + k) = RK.col(place) * prior.scale[place];
    cost.prior[k] = prior.chi[place] / prior.scale[place];
  }
  cost.full = std::move(prior);
  return cost;
}

ScaledParameters at_prior(const ConsistencyCost& cost) {
  return {std::vector<Eigen::Matrix4d>(static_cast<std::size_t>(cost.links),
                                       Eigen::Matrix4d::Identity()),
          cost.prior};
}

Eigen::VectorXd stacked(const ScaledParameters& parameters) {
  const auto inertial = static_cast<Eigen::Index>(10 * parameters.S.size());
  Eigen::VectorXd x(inertial + parameters.actuators.size());
  for (std::size_t link = 0; link < parameters.S.size(); ++link) {
    x.segment<10>(static_cast<Eigen::Index>(10 * link)) =
        log_cholesky_map::upper_elements<double>(parameters.S[link]);
  }
  x.tail(parameters.actuators.size()) = parameters.actuators;
  return x;
}

Eigen::VectorXd to_chi(const ConsistencyCost& cost, const ScaledParameters& parameters) {
  Eigen::VectorXd chi = cost.full.chi;
  for (int link = 0; link < cost.links; ++link) {
    const auto place = static_cast<std::size_t>(link);
    chi.segment<10>(kChiPerLink * link) =
        ten_parameters(pseudo_inertia_of(cost.full.factors[place], parameters.S[place]));
  }
  for (int k = 0; k < cost.actuators(); ++k) {
    const int place = cost.places[static_cast<std::size_t>(k)];
    chi[place] = parameters.actuators[k] * cost.full.scale[place];
  }
  return chi;
}

double prior_distance(const ConsistencyCost& cost, const ScaledParameters& parameters) {
  double distance = (parameters.actuators - cost.prior).squaredNorm();
  for (const Eigen::Matrix4d& S : parameters.S) {
    const Eigen::LLT<Eigen::Matrix4d> cholesky(S);
    if (cholesky.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    const Eigen::Matrix4d L = cholesky.matrixL();
    distance += S.trace() - 2 * L.diagonal().array().log().sum() - 4;
  }
  return distance;
}

double data_cost(const ConsistencyCost& cost, const ScaledParameters& parameters) {
  return (cost.A * stacked(parameters) - cost.b).squaredNorm();
}

}  // namespace dyngen::runtime
