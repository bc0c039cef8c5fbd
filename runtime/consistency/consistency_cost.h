// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/consistency/consistency_prior.h"
#include "runtime/consistency/consistent_parameters.h"

namespace dyngen::runtime {

/// The search's own unknowns, without units: the prior is S = 1 and a = a0.
struct ScaledParameters {
  std::vector<Eigen::Matrix4d> S;  ///< (links) J = U0 S U0', symmetric, positive definite
  Eigen::VectorXd actuators;       ///< (na) the free ones of IA..OFF over their scale
};

/// The problem in these unknowns: ||A x - b||^2 + w (sum D(S || 1) + ||a - a0||^2),
/// x = [ten upper elements of S of each link; a].
struct ConsistencyCost {
  int links = 0;
  double weight = 0;              ///< w
  Eigen::MatrixXd A;              ///< (nb x 10 links + na)
  Eigen::VectorXd b;              ///< (nb)
  std::vector<int> places;        ///< (na) place of an actuator in chi
  std::vector<bool> nonnegative;  ///< (na)
  Eigen::VectorXd prior;          ///< (na) a0
  ConsistencyPrior full;

  [[nodiscard]] int inertial_size() const { return 10 * links; }
  [[nodiscard]] int actuators() const { return static_cast<int>(places.size()); }
};

ConsistencyCost make_cost(const ConsistencyProblem& problem, ConsistencyPrior prior);

/// S = 1, a = a0.
ScaledParameters at_prior(const ConsistencyCost& cost);

/// x of the data's residual A x - b.
Eigen::VectorXd stacked(const ScaledParameters& parameters);

/// (14 links) with the parameters that are not free.
Eigen::VectorXd to_chi(const ConsistencyCost& cost, const ScaledParameters& parameters);

/// sum D(S || 1) + ||a - a0||^2; infinite if an S is not positive definite.
double prior_distance(const ConsistencyCost& cost, const ScaledParameters& parameters);

/// ||A x - b||^2
double data_cost(const ConsistencyCost& cost, const ScaledParameters& parameters);

}  // namespace dyngen::runtime
