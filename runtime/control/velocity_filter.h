// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

struct VelocityFilterOptions {
  double sample_time = 1e-3;  ///< s, between updates, positive
  double cutoff_hz = 60;      ///< Hz, positive; infinite: the bare difference

  /// @throws std::invalid_argument
  void validate() const;
};

/// Joint velocity from an encoder: the difference of two positions behind a first-order low-pass,
/// v <- a v + (1 - a) (q - q_before) / h with a = exp(-2 pi cutoff h).
///
/// It lags by h / 2 and, well below the cut-off, by another 1 / (2 pi cutoff).
class VelocityFilter {
 public:
  /// @param q  (n) the first position; the robot is taken to move with dq
  /// @throws std::invalid_argument  if an option is wrong or the sizes differ
  VelocityFilter(const VelocityFilterOptions& options, const Eigen::VectorXd& q,
                 const Eigen::VectorXd& dq);

  /// The position `sample_time` after the one before. No allocation. @param q  n values
  /// @return  the velocity, valid until the next update
  const Eigen::VectorXd& update(const double* q) noexcept;

 private:
  double forget_, gain_;
  Eigen::VectorXd before_, dq_;
};

}  // namespace dyngen::runtime
