// SPDX-License-Identifier: MIT
// Parameters of a real body, near an estimate that no body has.
#include <cmath>
#include <cstdio>

#include "runtime/consistency/consistent_parameters.h"

using namespace dyngen::runtime;

int main() {
  // Of one link, ZZ was found: -0.1 kg m^2 with a standard deviation of 0.2.
  constexpr Eigen::Index kParameters = 14, kZz = 5;
  ConsistencyProblem problem;
  problem.links = 1;
  problem.K = Eigen::MatrixXd::Zero(1, kParameters);
  problem.K(0, kZz) = 1;
  problem.R = Eigen::MatrixXd::Constant(1, 1, 1 / 0.2);
  problem.z = Eigen::VectorXd::Constant(1, -0.1 / 0.2);
  problem.prior = Eigen::VectorXd::Constant(kParameters, std::nan(""));
  problem.free.assign(kParameters, false);
  for (std::size_t k = 0; k < 10; ++k) problem.free[k] = true;
  const ConsistentEstimate estimate = fit_consistent(problem);
  std::printf("ZZ = %.4f kg m^2\n", estimate.chi[kZz]);
  return estimate.chi[kZz] > 0 && estimate.smallest_eigenvalue[0] > 0 ? 0 : 1;
}
