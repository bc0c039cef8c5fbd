// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <numbers>
#include <vector>

#include "runtime/ripple/ripple.h"

namespace dyngen::runtime {

/// Orders are periods per turn.
inline constexpr double kOrderTurn = 2 * std::numbers::pi;

/// Samples of one run between two reversals.
struct OneWay {
  Eigen::Index from = 0, to = 0;  ///< [from, to)
  int direction = 1;              ///< 1 or -1
};

/// The residual of one joint behind the inverse of its noise's autoregression, so that its noise is
/// white and of unit variance where samples count.
class WhiteResidual {
 public:
  WhiteResidual(const RippleData& data, const RippleRules& rules);

  [[nodiscard]] bool usable() const { return innovation_ > 0; }
  [[nodiscard]] double innovation() const { return innovation_; }  ///< N m
  [[nodiscard]] const std::vector<OneWay>& stretches() const { return stretches_; }
  /// (N) 1, -1 or 0: the sample does not count
  [[nodiscard]] const Eigen::VectorXd& direction() const { return direction_; }
  [[nodiscard]] Eigen::Index counted() const { return counted_; }
  [[nodiscard]] const Eigen::VectorXd& start() const { return start_; }
  [[nodiscard]] const RippleData& data() const { return data_; }

  /// A signal behind the same filter, at all samples of all runs.
  [[nodiscard]] Eigen::VectorXd filtered(const Eigen::VectorXd& signal) const;
  /// The transposed filter: products with filtered signals become products with signals.
  [[nodiscard]] Eigen::VectorXd transposed(const Eigen::VectorXd& white) const;
  /// Square of the filter's gain. @param frequency  periods per sample
  [[nodiscard]] double gain(double frequency) const;
  /// (N) 1 where a sample counts and sees less than `most` periods of an order per sample.
  [[nodiscard]] Eigen::VectorXd seen(double order, double most) const;

 private:
  const RippleData& data_;
  Eigen::VectorXd coefficients_, direction_, start_;
  double innovation_ = 0;
  std::vector<OneWay> stretches_;
  Eigen::Index counted_ = 0;
};

/// First sample of the run behind run `i`.
Eigen::Index end_of_run(const RippleData& data, std::size_t i);

}  // namespace dyngen::runtime
