// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

enum class Criterion {
  kCondition,    ///< log of the condition number of the regressor, sqrt(largest / smallest of R)
  kDeterminant,  ///< D-optimality: -log det R / size
  kTrace,        ///< A-optimality: log trace R^-1, the sum of variances
  kSmallest,     ///< -log of the smallest eigenvalue of R
};

struct CriterionOptions {
  Criterion criterion = Criterion::kCondition;
  bool unit_columns = false;  ///< of D R D with ones on its diagonal
  /// Largest and smallest eigenvalues are replaced by p-norms of all of R and of R^-1, which have
  /// derivatives where eigenvalues meet; the larger p, the closer: within log(size) / p.
  double power = 8;

  /// @throws std::invalid_argument  naming what was found and what was expected
  void validate() const;
};

/// A criterion of R, to be minimised, and its derivatives.
struct CriterionValue {
  double value = 0;          ///< infinite if R is not positive definite
  Eigen::MatrixXd gradient;  ///< by R, symmetric
};

/// @param R  (p x p), symmetric
/// Source: Pukelsheim, "Optimal Design of Experiments" (1993), chapter 6, for the matrix means
/// (trace R^-p)^(1/p), of which D, A and the smallest eigenvalue are p -> 0, 1 and infinity.
CriterionValue evaluate(const Eigen::MatrixXd& R, const CriterionOptions& options);

}  // namespace dyngen::runtime
