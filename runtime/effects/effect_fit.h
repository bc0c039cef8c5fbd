// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/effects/effect_remarks.h"
#include "runtime/effects/effect_rows.h"
#include "runtime/estimation/least_squares.h"
#include "runtime/estimation/noise_model.h"

namespace dyngen::runtime {

struct EffectFitOptions {
  bool weighted = true;     ///< joints by the reciprocal of their residual's deviation; else alike
  int most_rounds = 4;      ///< of weights
  int most_steps = 60;      ///< of the search for shapes, in each round
  double tolerance = 1e-9;  ///< relative change of the cost at which a search stops
  int refined = 3;          ///< best values of a grid from which a search starts
  int grid = 9;             ///< values that are tried of a shape without a number
  /// Of the equations, which intervals are told by; none: that of the residual.
  std::optional<KnownNoise> noise;

  /// @throws std::invalid_argument  naming the option and its range
  void validate() const;
};

/// What was found about a parameter of an effect.
struct EffectParameterFit {
  double value = 0;
  double stddev = 0;  ///< 0 where it was held, or is at its bound
  bool held = false;  ///< the file's number, or what a scan found of a step in time
  bool at_bound = false;
  bool seen = true;  ///< false: the recordings do not determine it
};

/// A model with effects, fitted to recordings.
struct EffectFit {
  EffectPoint point;                                        ///< the estimate
  std::vector<std::vector<EffectParameterFit>> parameters;  ///< [effect][parameter]
  /// [effect] (np x np) covariance of the parameters' values; rows of what is held are 0
  std::vector<Eigen::MatrixXd> covariance;
  Estimate base;                 ///< of beta, with its covariance in the presence of the effects
  Eigen::VectorXd textbook;      ///< (nb) standard deviations as if noise were white
  double interval = 1.96;        ///< a 95 % interval is value +- interval * stddev
  Eigen::VectorXd rms;           ///< (n) residual, N m or N
  Eigen::VectorXd rms_without;   ///< (n) of the model without effects, fitted to the same equations
  Eigen::VectorXd beta_without;  ///< (nb) of that fit
  std::vector<EffectRemark> remarks;
  int steps = 0;  ///< that the search took, over all rounds
  bool converged = true;

  [[nodiscard]] bool all_seen() const;
  /// Whether a remark speaks against an effect: a parameter that is not seen does not as long as
  /// another one of the effect is, as the rest position of a spring beside the joint's offset. What
  /// is unusual does not: it is possible.
  [[nodiscard]] bool objects(const EffectRemark& remark, int effect) const;
};

/// Told how far the work is: a name and a fraction.
using EffectProgress = std::function<void(const std::string& what, double done)>;

/// Estimates beta, the parameters of effects and the states at the beginning of each run together:
///
///     minimise  sum over joints of ||tau_j - (Y_j beta + e_j(p, eta; beta, z0))||^2 / sigma_j^2
///
/// under constraints_at(). Variable projection: beta and the linear p are solved exactly for every
/// trial of the shapes eta and of z0, whose steps are those of Levenberg and Marquardt on all
/// unknowns together (Kaufman's approximation). A shape without a number (NaN) starts at the best
/// of a grid. What effects read of the model (tau_load, Fc) moves with beta by the chain rule.
///
/// Covariance: as correlated_covariance(), over the full Jacobian; at a constraint that holds the
/// estimate back, within it.
/// @param effects  those of the robot with numbers or NaN
/// @throws std::invalid_argument  if an effect does not fit the model, a given parameter has no
/// number
/// @throws MissingSignalError  if a recording lacks what an effect reads
/// @throws NotFiniteError  if the torque of the effects is not finite where the search begins
/// Source: Golub and Pereyra, "The differentiation of pseudo-inverses and nonlinear least squares
/// problems whose variables separate", SIAM J. Numer. Anal. 1973; Kaufman, "A variable projection
/// method for solving separable nonlinear least squares problems", BIT 1975.
EffectFit fit_effects(const EffectRecordings& data, const std::vector<EffectInstance>& effects,
                      const EffectFitOptions& options = {}, const EffectProgress& progress = {});

}  // namespace dyngen::runtime
