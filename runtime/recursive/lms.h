// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace dyngen::runtime {

/// Settings of Lms. nb is gain.size().
struct LmsOptions {
  Eigen::VectorXd gain{};           ///< (nb) diagonal of Gamma, >= 0, one > 0; see propose_gain()
  Eigen::VectorXd joint_weights{};  ///< (n) >= 0, for instance 1/variance of the torque; empty: 1
  Eigen::VectorXd start{};          ///< (nb) first estimate; empty: 0
  /// Divides every step by floor + tr(Y Gamma Y' diag(joint_weights)). Only the ratios of the gains
  /// count then (the square of what each parameter may weigh), and no sample can enlarge the error.
  bool normalised = false;
  double step = 0.5;   ///< (0, 2) of the normalised form; not used otherwise
  double floor = 0.0;  ///< >= 0; keeps the steps of samples without excitation small

  /// @throws std::invalid_argument  if a size, sign or range is wrong
  void validate(int joints) const;
};

/// Least mean squares: beta += Gamma sum_j w_j Y_j' (tau_j - Y_j beta), thesis 1995, eq. 5.1.
///
/// The cheapest estimator, O(n nb) a sample, and the slowest: see slowest_time_constant(). It is
/// stable if peak_gain() < 2.
class Lms {
 public:
  /// Takes all memory. @param joints  n >= 1
  /// @throws std::invalid_argument  from LmsOptions::validate()
  Lms(int joints, LmsOptions options);

  /// One sample (layout: sample.h). @return false, and nothing has changed, if the sample is not
  /// finite, the estimate would not stay so, or (normalised) Y is zero.
  bool update(const double* Y, const double* tau) noexcept;

  [[nodiscard]] const Eigen::VectorXd& beta() const noexcept { return beta_; }
  [[nodiscard]] std::int64_t samples() const noexcept { return samples_; }  ///< used ones

 private:
  LmsOptions options_;
  Eigen::VectorXd beta_, increment_, candidate_;
  std::int64_t samples_ = 0;
};

/// What Lms and ConvergentModeLms ask of their common settings.
/// @throws std::invalid_argument  naming `caller`
void validate_gains(const char* caller, int joints, const Eigen::VectorXd& gain,
                    const Eigen::VectorXd& joint_weights, const Eigen::VectorXd& start);

}  // namespace dyngen::runtime
