// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "runtime/recursive/sample.h"

namespace dyngen::runtime {

/// Settings of Rls.
struct RlsOptions {
  double forgetting = 1;               ///< (0, 1]: weight of a sample against the next one
  Eigen::VectorXd noise_stddev{};      ///< (n) > 0, N m or N, of the torques; empty: 1
  Eigen::VectorXd prior_mean{};        ///< (nb) first estimate; empty: 0
  Eigen::MatrixXd prior_covariance{};  ///< (nb x nb) positive definite; empty: nothing is known
  /// (nb) > 0, with forgetting < 1: no standard deviation grows beyond it while a parameter is not
  /// excited. Held by weak equations "stay where you are", one a sample, the parameters in turn.
  /// Empty: no bound.
  Eigen::VectorXd max_stddev{};

  /// @throws std::invalid_argument  if a size, sign or range is wrong
  void validate(int joints, int parameters) const;
};

/// Recursive least squares with exponential forgetting: after sample N, beta minimises
///     sum_k forgetting^(N-k) |S^-1 (tau_k - Y_k beta)|^2 + forgetting^N |beta - prior|^2_(P0^-1),
/// S = diag(noise_stddev).
///
/// Kept is the triangular square root of the information matrix, Rt'Rt = P^-1, and a right-hand
/// side relative to the present estimate. A sample's n rows are reflected into it (Householder),
/// and the correction of beta is solved for. P is positive definite by construction, however many
/// samples there are. O(n nb^2) a sample.
///
/// Without a prior, beta stays at prior_mean until the samples determine every parameter. Later, a
/// parameter whose information has been forgotten (by a factor of 1e-12 against what other
/// parameters explain of it) is held where it is; determined() tells.
class Rls {
 public:
  /// Takes all memory. @param joints, parameters  n, nb >= 1
  /// @throws std::invalid_argument  from RlsOptions::validate()
  Rls(int joints, int parameters, const RlsOptions& options = {});

  /// One sample (layout: sample.h). @return false, and nothing has changed, if the sample is not
  /// finite or the estimate would not stay so
  bool update(const double* Y, const double* tau) noexcept;

  [[nodiscard]] const Eigen::VectorXd& beta() const noexcept { return beta_; }
  /// (nb x nb) of beta, if noise_stddev is right; not a number while !determined(). Allocates.
  [[nodiscard]] Eigen::MatrixXd covariance() const;
  [[nodiscard]] bool determined() const noexcept { return determined_; }
  [[nodiscard]] std::int64_t samples() const noexcept { return samples_; }  ///< used ones

 private:
  void load(const double* Y, const double* tau) noexcept;
  void reflect() noexcept;
  void solve() noexcept;

  Eigen::VectorXd inverse_stddev_;
  double sqrt_forgetting_ = 1;
  Eigen::VectorXd hold_;  // weight of the equation "stay", by parameter; empty: none
  Eigen::Index turn_ = 0, next_turn_ = 0;
  bool started_ = false, next_started_ = false, determined_ = false, next_determined_ = false;
  std::int64_t samples_ = 0;

  // The state, and the one that a sample leads to: swapped if all is finite.
  RowMajorMatrix Rt_, next_Rt_;
  Eigen::VectorXd z_, next_z_, beta_, next_beta_;
  // Scratch: the new rows, their right-hand side, a row of products, squared lengths of columns.
  RowMajorMatrix X_;
  Eigen::VectorXd x_;
  Eigen::RowVectorXd products_, lengths_;
  Eigen::VectorXd delta_;
};

}  // namespace dyngen::runtime
