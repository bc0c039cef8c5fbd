// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "runtime/estimation/torque_factor.h"

namespace dyngen::runtime {

enum class EstimateStatus {
  kDone,
  kRankDeficient,  ///< some combinations of parameters are not seen: they keep the prior's values
};

/// What a fit says.
struct Estimate {
  Eigen::VectorXd beta;           ///< (nb)
  Eigen::MatrixXd covariance;     ///< (nb x nb); 0 x 0 until covariance() has been asked
  Eigen::VectorXd joint_weights;  ///< (n) that were used, 1/sigma
  Eigen::VectorXd residual_rms;   ///< (n) N m or N, over the rows of the fit
  double condition = 0;           ///< of the regressor with columns of unit norm
  double raw_condition = 0;       ///< of the regressor as it is
  int rank = 0;
  /// Orthonormal directions that the data do not see, or that were left out, in parameters divided
  /// by their scale: (nb x nb - rank).
  Eigen::MatrixXd unseen;
  Eigen::VectorXd scale;  ///< (nb) parameter = scaled parameter * scale
  EstimateStatus status = EstimateStatus::kDone;
  std::string message;

  [[nodiscard]] Eigen::VectorXd stddev() const { return covariance.diagonal().cwiseSqrt(); }
};

/// Orthogonal decomposition that solves the equations.
enum class Decomposition { kQr, kSvd };

struct LeastSquaresOptions {
  Decomposition decomposition = Decomposition::kQr;
  /// A direction is not seen if its singular value is below this part of the largest one (columns
  /// of unit norm).
  double tolerance = 1e-9;
  /// How many of the weakest directions to leave out besides (kSvd).
  int dropped_directions = 0;
  Eigen::VectorXd prior{};  ///< (nb) in directions that are not seen; empty: zeros
  /// (nb) columns are multiplied by it before the decomposition; empty: 1/norm.
  Eigen::VectorXd scale{};

  void validate(int parameters) const;
};

/// minimise sum over joints of w_j^2 ||tau_j - Y_j beta||^2, columns scaled to unit norm.
///
/// @param joint_weights  (n), positive       @return  covariance is empty
/// @throws std::invalid_argument  if a size is wrong
/// Source: Lawson and Hanson, "Solving Least Squares Problems", 1974; the thesis, 4.3.
Estimate least_squares(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights,
                       const LeastSquaresOptions& options = {});

/// Weighted least squares: each joint's weight is the reciprocal of the standard deviation of its
/// residual, found by repeating the fit.
///
/// Source: Gautier, "Dynamic identification of robots with power model", ICRA 1997 (weights of each
/// joint from its own residual).
Estimate weighted_least_squares(const TorqueFactor& factor,
                                const LeastSquaresOptions& options = {});

/// Standard deviation of each joint's residual: sqrt(squares / (rows - parameters that act on it)).
/// Where there are no more rows than parameters: rms of its torque; 1 where it has no torque.
Eigen::VectorXd residual_deviation(const TorqueFactor& factor, const Eigen::VectorXd& beta);

/// The same equations with fewer parameters. @param kept  ascending places of parameters
TorqueFactor with_columns(const TorqueFactor& factor, const std::vector<int>& kept);

/// Singular values of the stacked rows, columns multiplied by scale (empty: as they are), falling.
Eigen::VectorXd singular_values(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights,
                                const Eigen::VectorXd& scale);

/// Largest over smallest; infinite if the smallest is 0.
double condition_number(const Eigen::VectorXd& singular_values);

}  // namespace dyngen::runtime
