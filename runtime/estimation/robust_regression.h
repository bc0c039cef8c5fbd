// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// Least squares whose covariance holds for noise of any correlation.
struct RobustRegression {
  Eigen::VectorXd beta;        ///< (k)
  Eigen::MatrixXd covariance;  ///< (k x k)
  Eigen::MatrixXd inverse;     ///< (D'D)^-1; a pseudo-inverse where columns depend on one another
  Eigen::VectorXd residual;    ///< (N)
  int degrees = 0;             ///< of the covariance: of Student's t for one parameter

  [[nodiscard]] double deviation(Eigen::Index i) const;
  /// P of a parameter as far from 0 as this one, if it is 0.
  [[nodiscard]] double chance(Eigen::Index i) const;
  /// The same of `count` parameters from `first` on together.
  [[nodiscard]] double chance(Eigen::Index first, Eigen::Index count) const;
};

/// Degrees of freedom for so many independent rows: 0.2 n^(2/3), at least 4. That is half of what
/// is recommended for tests of one mean, so that intervals of short recordings hold.
/// Source: Lazarus, Lewis, Stock and Watson, "HAR inference: recommendations for practice", 2018.
int cosines_for(double independent_rows);

/// Sums of each column times cos(pi j (i + 1/2) / N), j = 1 .. cosines: the orthonormal series that
/// tells slow noise from the mean, which none of them sees.
/// @param columns  (N x k)       @return (k x cosines)
Eigen::MatrixXd cosine_sums(const Eigen::MatrixXd& columns, int cosines);

/// w = D beta + noise. The long-run covariance of the scores is the mean over `cosines` products
/// with the first cosines of half-integer periods (equal-weighted cosine estimator); tests are
/// Student's t and Fisher's F with as many degrees.
/// Source: Mueller 2004; Sun 2013, "A heteroskedasticity and autocorrelation robust F test using an
/// orthonormal series variance estimator".
RobustRegression robust_regression(const Eigen::MatrixXd& D, const Eigen::VectorXd& w, int cosines);

}  // namespace dyngen::runtime
