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
/// D the log-det divergence of consistent_parameters.h. Newton's method follows the path of the
/// bodies nearest to the prior whose base parameters are (1 - s) K ten(J0) + s beta, s from 0 to 1:
/// the prior is its beginning, and where bodies have beta, bodies have all that lies between. D is
/// self-concordant: from every point within the cone Newton's steps lead back to the path, which
/// ends before s = 1 only at the edge of what can exist.
/// Source: Boyd and Vandenberghe, "Convex Optimization", 2004, sections 9.6 and 10.2.
///
/// @throws std::invalid_argument  if a size is wrong, or K or beta is not finite
RealisedBodies realise_bodies(const RealisationProblem& problem);

}  // namespace dyngen::runtime
