// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/rules/steady_rules.h"
#include "runtime/steady/steady_runs.h"

namespace dyngen::runtime {

/// How strongly the residual of a stretch has the first cosines of half-integer periods.
struct CosinePowers {
  Stretch stretch;
  Eigen::VectorXd powers;  ///< (J) (N m)^2 s
};

/// @param residual  (count) of the stretch, about its mean
CosinePowers cosine_powers(const Stretch& stretch, const Eigen::VectorXd& residual,
                           const SteadyRules& rules);

/// Noise of a torque: white, and parts that are forgotten with a time each. The sum of such parts
/// can stand for any spectrum that falls, 1/f among them.
struct MeanNoise {
  double density = 0;        ///< (N m)^2 s of the white part
  Eigen::VectorXd memory;    ///< (K) s
  Eigen::VectorXd variance;  ///< (K) (N m)^2
  int degrees = 1;           ///< by which it is known: two lowest cosines of each stretch

  /// Covariance of the means over two stretches, which are one or have no row in common.
  [[nodiscard]] double of_means(const Stretch& a, const Stretch& b) const;
};

/// The spectrum that explains the powers of all stretches best (Whittle's likelihood), by
/// multiplicative steps that never lower it.
/// Source: Mueller 2004 (the cosines); Whittle 1953; Fevotte, Bertin and Durrieu 2009 (the steps).
/// @throws std::invalid_argument  if there is no stretch
MeanNoise fit_mean_noise(const std::vector<CosinePowers>& stretches, const SteadyRules& rules);

/// (R x R) of the means over all stretches.
Eigen::MatrixXd covariance_of_means(const MeanNoise& noise, const std::vector<Stretch>& stretches);

}  // namespace dyngen::runtime
