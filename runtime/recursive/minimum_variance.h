// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "runtime/recursive/sample.h"
#include "runtime/recursive/ud_covariance.h"

namespace dyngen::runtime {

/// Settings of MinimumVariance. nb is prior_covariance.rows(), n is measurement_covariance.rows().
struct MinimumVarianceOptions {
  Eigen::VectorXd prior_mean{};        ///< (nb) first estimate; empty: 0
  Eigen::MatrixXd prior_covariance{};  ///< (nb x nb) positive definite: of prior_mean
  /// (nb x nb) positive semidefinite: by how much the parameters wander from sample to sample;
  /// empty: not at all
  Eigen::MatrixXd walk_covariance{};
  Eigen::MatrixXd measurement_covariance{};  ///< (n x n) positive definite, (N m)^2: of tau

  /// @throws std::invalid_argument  if a size is wrong or a matrix is not as described
  void validate() const;
};

/// Minimum variance estimator: the Kalman filter whose state is the parameters, a random walk of
/// covariance Q a sample (thesis 1995, section 8.2):
///     C += Q;   K = C Y' (Y C Y' + R)^-1;   beta += K (tau - Y beta);   C -= K Y C.
/// (There Q and R name each other's covariances.) Time passes before every sample but the first, so
/// that covariance() is that of beta() at the last sample.
///
/// C is kept as U D U' and the joints are taken in one by one, after R has been made the identity
/// by its Cholesky factor. O(n nb^2) a sample, and O(nb^3) more for Q: a zero Q costs nothing. With
/// Q = 0, R = diag(noise_stddev^2) it is Rls without forgetting.
class MinimumVariance {
 public:
  /// Takes all memory. @throws std::invalid_argument  from MinimumVarianceOptions::validate()
  explicit MinimumVariance(const MinimumVarianceOptions& options);

  /// One sample (layout: sample.h). @return false, and nothing has changed, if the sample is not
  /// finite or the estimate would not stay so
  bool update(const double* Y, const double* tau) noexcept;

  [[nodiscard]] const Eigen::VectorXd& beta() const noexcept { return beta_; }
  [[nodiscard]] Eigen::MatrixXd covariance() const { return C_.matrix(); }  ///< Allocates.
  [[nodiscard]] std::int64_t samples() const noexcept { return samples_; }  ///< used ones
  /// e' (Y C Y' + R)^-1 e of the last used sample, e = tau - Y beta before it: chi-square with n
  /// degrees of freedom if the model and the covariances are right. Far larger: an outlier,
  /// contact.
  [[nodiscard]] double innovation_squared() const noexcept { return innovation_squared_; }

 private:
  UdCovariance C_, next_C_, Q_;
  bool walks_ = false;
  RowMajorMatrix L_;  // R = L L'
  Eigen::VectorXd beta_, next_beta_;
  RowMajorMatrix H_;   // L^-1 Y
  Eigen::VectorXd z_;  // L^-1 tau
  double innovation_squared_ = 0;
  std::int64_t samples_ = 0;
};

}  // namespace dyngen::runtime
