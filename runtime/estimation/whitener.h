// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/joint_noise.h"

namespace dyngen::runtime {

/// Makes the noise of one joint in one run white and of unit variance: a sample less its best
/// linear prediction from all that count before it, over the deviation of what the prediction
/// misses. Exact at the begin of a run and behind samples that do not count.
/// Source: the innovations of a Kalman filter (Kalman 1960) whose state is the past of the
/// autoregressive part and the slow parts; there is no noise of measurement.
class Whitener {
 public:
  /// @param noise    of a stationary process, innovation > 0
  /// @param counted  (N) 1 or 0, of the run
  Whitener(const JointNoise& noise, const Eigen::Ref<const Eigen::VectorXd>& counted);

  /// In place; samples that do not count become 0. @param columns  (N x k)
  void apply(Eigen::Ref<Eigen::MatrixXd> columns) const;

 private:
  struct Step {
    std::size_t gain = 0;  ///< where its gains begin
    double deviation = 0;  ///< of what the prediction misses; 0: the sample does not count
  };
  template <int kTogether>
  class Columns;
  template <int kTogether>
  void apply_to(const std::vector<double*>& columns) const;

  Eigen::VectorXd coefficients_;  ///< (m) of the autoregressive part, m at least 1
  Eigen::VectorXd poles_;         ///< of the slow parts
  std::vector<Step> steps_;       ///< of each sample
  std::vector<double> gains_;     ///< (m + slow) of the state, each as often as it changes
  Eigen::Index reach_ = 1;        ///< how far back samples of the autoregressive part are corrected
};

}  // namespace dyngen::runtime
