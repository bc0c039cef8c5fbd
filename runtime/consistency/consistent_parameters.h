// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// What is known of a robot: measured base parameters beta = K chi, and a guess of chi.
///
/// chi has 14 entries a link, in the order and units of gen/model/chi.h: XX XY XZ YY YZ ZZ MX MY MZ
/// M IA FV FS OFF.
struct ConsistencyProblem {
  int links = 0;          ///< at least 1
  Eigen::MatrixXd K;      ///< (nb x 14 links)
  Eigen::MatrixXd R;      ///< (nb x nb) whitened: data cost ||R beta - z||^2; may be rank deficient
  Eigen::VectorXd z;      ///< (nb) in standard deviations
  Eigen::VectorXd prior;  ///< (14 links) for instance of CAD; NaN where there is none
  std::vector<bool> free;  ///< (14 links) false: IA..OFF stay at their prior (0 if NaN). Of the ten
                           ///< inertial parameters it is not read: they are free always
  double prior_weight = 1e-3;  ///< w > 0, variances of data that a unit of prior distance is worth
};

/// How the minimum is searched. It is the same one.
enum class ConsistencySearch {
  kCentralPath,  ///< interior-point steps in chi; where they should not converge, Ceres goes on
  kLogCholesky,  ///< Ceres from the prior in log-Cholesky coordinates: slow where R is well known
};

struct ConsistencyOptions {
  double default_mass = 1;  ///< kg, > 0: the prior of a link that has no consistent one is a ball
  double default_radius = 0.1;  ///< m, > 0: of that ball, around the origin of the link's frame
  double prior_margin = 1e-8;   ///< [0, 1): how far from singular a prior must be (see below)
  double actuator_scale = 1;    ///< > 0: unit of prior distance where IA, FV, FS, OFF have no prior
  ConsistencySearch search = ConsistencySearch::kCentralPath;
  int max_iterations = 500;  ///< >= 1, of Ceres in each of its rounds
  double floor = 1e-3;  ///< (0, 1), of Ceres: least mass^(1/2) and radii, as parts of the prior's

  /// @throws std::invalid_argument  if one is out of its range
  void validate() const;
};

struct ConsistentEstimate {
  Eigen::VectorXd chi;   ///< (14 links) consistent; IA, FV, FS >= 0
  Eigen::VectorXd beta;  ///< (nb) K chi
  /// (nb) (beta - beta_free) / std_free: which measured base parameters pull against consistency;
  /// 0 where R does not determine beta_free
  Eigen::VectorXd pull;
  double cost_free = 0;                 ///< least ||R b - z||^2 of any b
  double cost = 0;                      ///< ||R beta - z||^2 >= cost_free
  double prior_distance = 0;            ///< what prior_weight was multiplied with
  Eigen::VectorXd smallest_eigenvalue;  ///< (links) of the pseudo-inertias, > 0
  std::vector<bool> at_bound;           ///< (14 links) IA, FV, FS at 0 that data want negative
  bool converged = false;
  std::string message;  ///< replaced priors, bounds, rank: sentences, one a line; empty if none
};

/// The physically consistent parameters that are closest to the data,
///
///     min  ||R K chi - z||^2 + w (sum over links D(J || J0) + sum over IA FV FS OFF ((x-x0)/s)^2)
///     over chi whose pseudo-inertias J are positive definite and whose IA, FV, FS are >= 0.
///
/// D(J || J0) = tr(J0^-1 J) - log det(J0^-1 J) - 4 is the log-det divergence from the prior J0
/// (Lee, Wensing and Park 2020): it depends on the two bodies alone, not on frame, origin or units,
/// and grows without limit towards the edge of consistency. s = |x0|, or actuator_scale if x0 is 0
/// or NaN (then x0 = 0).
///
/// The cost is strictly convex in chi and has one minimum; the same input gives the same result.
/// The two searches are consistency_path.h and log_cholesky_fit.h.
///
/// A prior is replaced by the default ball, and message says so, if one of the ten is NaN or if the
/// smallest eigenvalue of its pseudo-inertia, scaled to unit diagonal, is not above prior_margin.
///
/// @throws std::invalid_argument  if a size, sign or option is wrong, or K, R or z is not finite
/// @return  converged = false and a sentence in message if the search did not end
ConsistentEstimate fit_consistent(const ConsistencyProblem& problem,
                                  const ConsistencyOptions& options = {});

}  // namespace dyngen::runtime
