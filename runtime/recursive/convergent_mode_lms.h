// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cstdint>

#include "runtime/recursive/sample.h"

namespace dyngen::runtime {

/// Which modes of a sample's step are kept.
enum class KeptModes {
  kMostStable,  ///< the one of smallest |1 - lambda| (thesis 1995, section 7.2.2)
  kAllStable    ///< all with |1 - lambda| < 1 (thesis 1995, section 8.1, of "the stable modes")
};

/// Settings of ConvergentModeLms. nb is gain.size().
struct ConvergentModeOptions {
  Eigen::VectorXd gain{};           ///< (nb) diagonal of Gamma, >= 0, one > 0; see propose_gain()
  Eigen::VectorXd joint_weights{};  ///< (n) >= 0; empty: 1
  Eigen::VectorXd start{};          ///< (nb) first estimate; empty: 0
  KeptModes modes = KeptModes::kMostStable;
  /// rad/s or m/s, >= 0. Samples in which no joint is faster are left out: stiction is not in the
  /// model (thesis 1995, section 8.1). 0: none is left out, and dq may be null.
  double moving_speed = 0;

  /// @throws std::invalid_argument  if a size, sign or range is wrong, or n > 12
  void validate(int joints) const;
};

/// LMS whose increments are kept along the most stable mode only: thesis 1995, eq. 7.1 and the text
/// after it.
///
/// A step of LMS maps the error by M = I - Gamma H H' (nb x nb; H = Y' sqrt(w)). With A =
/// Gamma^1/2 H, M is similar to the symmetric I - A A': all but n of its eigenvalues are 1. From
/// the small problem A'A u = lambda u (n x n) follow the others,
///     M v = (1 - lambda) v,   v = Gamma^1/2 A u = Gamma H u,   v_i' Gamma^-1 v_j = 0.
/// The step of LMS, Gamma H eps with eps = sqrt(w) (tau - Y beta), is the sum of its parts along
/// them, Gamma H u_i (u_i' eps). Kept is the part whose eigenvalue 1 - lambda is smallest in
/// magnitude, that is whose lambda is nearest to 1: the largest one if all are below 1; if some are
/// above, the one that overshoots or idles least. Measured by e' Gamma^-1 e, the error's component
/// along v becomes (1 - lambda) of what it was and the others stay: no step enlarges the error if 0
/// < lambda < 2. If no lambda is in that range the sample is passed over.
///
/// Hence: with one joint this is LMS that passes over samples whose gain is too large. If all
/// lambda are below 2 it takes a part of LMS's contraction and cannot be faster. Its use is a gain
/// that some samples are too strong for: LMS diverges there.
///
/// O(n^2 nb + n^3) a sample.
class ConvergentModeLms {
 public:
  static constexpr int kMaxJoints = 12;

  /// Takes all memory. @param joints  1 to 12
  /// @throws std::invalid_argument  from ConvergentModeOptions::validate()
  ConvergentModeLms(int joints, ConvergentModeOptions options);

  /// One sample (layout: sample.h); dq (n) rad/s or m/s is needed if moving_speed > 0.
  /// @return false, and nothing has changed, if the sample is not finite, no joint moves, there is
  ///         no stable mode, or the estimate would not stay finite
  bool update(const double* Y, const double* tau, const double* dq = nullptr) noexcept;

  [[nodiscard]] const Eigen::VectorXd& beta() const noexcept { return beta_; }
  [[nodiscard]] std::int64_t samples() const noexcept { return samples_; }  ///< used ones
  /// 1 - lambda of the mode that the last used sample was kept along (the most stable one).
  [[nodiscard]] double mode_eigenvalue() const noexcept { return mode_eigenvalue_; }

 private:
  using SmallMatrix =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxJoints, kMaxJoints>;
  using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxJoints, 1>;

  [[nodiscard]] bool moving(const double* dq) const noexcept;
  [[nodiscard]] bool kept(double lambda, double nearest) const noexcept;

  ConvergentModeOptions options_;
  Eigen::VectorXd beta_, candidate_, gain_sqrt_, weight_sqrt_;
  RowMajorMatrix A_;  // transposed: n x nb
  SmallMatrix G_;
  SmallVector eps_, along_;
  Eigen::SelfAdjointEigenSolver<SmallMatrix> modes_;
  double mode_eigenvalue_ = 1;
  std::int64_t samples_ = 0;
};

}  // namespace dyngen::runtime
