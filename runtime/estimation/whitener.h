// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/noise_model.h"

namespace dyngen::runtime {

/// Makes autoregressive noise white and of unit variance: a sample less its best prediction from
/// those before it, over the deviation of what the prediction misses.
///
/// At the begin of a run and behind samples that do not count there are fewer to predict from: the
/// predictor of that order stands there, so that the variance is 1 from the first sample on.
/// Source: the Levinson-Durbin recursion, run down from the process's own coefficients.
class Whitener {
 public:
  /// @param noise  of a stationary process, innovation > 0
  explicit Whitener(const AutoregressiveNoise& noise);

  /// In place.
  /// @param columns  (N x k) one run
  /// @param counted  (N) 1 or 0; samples that do not count become 0
  void apply(Eigen::Ref<Eigen::MatrixXd> columns,
             const Eigen::Ref<const Eigen::VectorXd>& counted) const;

 private:
  std::vector<Eigen::VectorXd> predictors_;  ///< of order 0, 1, ... p
  std::vector<double> deviations_;           ///< of what each misses
};

}  // namespace dyngen::runtime
