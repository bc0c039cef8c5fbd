// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

inline constexpr Eigen::Index kNoiseLags = 40;  ///< of a noise's process

/// A joint's residuals between what does not count; sums of their products at all lags, and of how
/// many pairs of samples.
class LagProducts {
 public:
  /// @param e  0 where `counted` is
  void add(const Eigen::VectorXd& e, const Eigen::VectorXd& counted);

  [[nodiscard]] double samples() const { return pairs_[0]; }
  /// (1 + kNoiseLags) means over the pairs.
  [[nodiscard]] Eigen::VectorXd of_pairs() const;

  /// (1 + kNoiseLags), of the process that predicts best within the stretches. What pairs of
  /// samples give would be wrong by a part of the variance at every frequency, about gaps above
  /// all: where noise of accelerations is hundreds of times what the slow parts are, nothing would
  /// be left of those.
  [[nodiscard]] Eigen::VectorXd covariance() const;

 private:
  std::vector<Eigen::VectorXd> stretches_;
  Eigen::VectorXd sums_ = Eigen::VectorXd::Zero(kNoiseLags + 1);
  Eigen::VectorXd pairs_ = Eigen::VectorXd::Zero(kNoiseLags + 1);
};

}  // namespace dyngen::runtime
