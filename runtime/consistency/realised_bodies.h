// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

namespace dyngen::runtime {

/// Given base parameters, and bodies from which others with these base parameters are wanted.
struct RealisationProblem {
  int bodies = 0;         ///< at least 1
  Eigen::MatrixXd K;      ///< (nb x 10 bodies) base parameters of the ten of each body
  Eigen::VectorXd beta;   ///< (nb)
  Eigen::VectorXd prior;  ///< (10 bodies) XX XY XZ YY YZ ZZ MX MY MZ M; NaN where there is none
};

struct RealisedBodies {
  Eigen::VectorXd ten;  ///< (10 bodies) each a body that exists
  /// Whether bodies were found whose base parameters are beta. False: no bodies have them, or the
  /// search did not end; `ten` is the last step of it then.
  bool exact = false;
  /// Largest |K ten - beta| over the sizes of what each row sums up.
  double residual = 0;
  double prior_distance = 0;  ///< sum of D(J || J0)
  std::string message;        ///< priors that were replaced: sentences, one a line; empty if none
};

/// The bodies nearest to a prior that have given base parameters,
///
///     min  sum over bodies D(J || J0)   over positive definite J with K ten(J) = beta,
///
/// D the log-det divergence of consistent_parameters.h. By Newton's method from the prior, which
/// does not fulfil the equations: each step solves min 1/2 ||dx||_H^2 + g' dx for K dx = what is
/// left of them, and stays within the cone.
/// Source: Boyd and Vandenberghe, "Convex Optimization", 2004, section 10.3.
///
/// @throws std::invalid_argument  if a size is wrong, or K or beta is not finite
RealisedBodies realise_bodies(const RealisationProblem& problem);

}  // namespace dyngen::runtime
