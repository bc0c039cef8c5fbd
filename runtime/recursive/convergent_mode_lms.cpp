// SPDX-License-Identifier: MIT
#include "runtime/recursive/convergent_mode_lms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "runtime/recursive/lms.h"

namespace dyngen::runtime {

void ConvergentModeOptions::validate(int joints) const {
  validate_gains("ConvergentModeOptions", joints, gain, joint_weights, start);
  if (joints > ConvergentModeLms::kMaxJoints) {
    throw std::invalid_argument(fmt::format("ConvergentModeOptions: {} joints, expected {} at most",
                                            joints, ConvergentModeLms::kMaxJoints));
  }
  if (!(moving_speed >= 0 && std::isfinite(moving_speed))) {
    throw std::invalid_argument(
        fmt::format("ConvergentModeOptions: moving_speed = {}, expected >= 0", moving_speed));
  }
}

ConvergentModeLms::ConvergentModeLms(int joints, ConvergentModeOptions options)
    : options_(std::move(options)) {
  options_.validate(joints);
  const Eigen::Index nb = options_.gain.size();
  if (options_.joint_weights.size() == 0) options_.joint_weights.setOnes(joints);
  if (options_.start.size() == 0) options_.start.setZero(nb);
  beta_ = options_.start;
  candidate_.setZero(nb);
  gain_sqrt_ = options_.gain.cwiseSqrt();
  weight_sqrt_ = options_.joint_weights.cwiseSqrt();
  A_.setZero(joints, nb);
  G_.setZero(joints, joints);
  eps_.setZero(joints);
  along_.setZero(joints);
}

bool ConvergentModeLms::moving(const double* dq) const noexcept {
  if (options_.moving_speed <= 0) return true;
  const Eigen::Index n = weight_sqrt_.size();
  return all_finite(dq, n) && VectorMap(dq, n).cwiseAbs().maxCoeff() > options_.moving_speed;
}

bool ConvergentModeLms::kept(double lambda, double nearest) const noexcept {
  const double size = std::abs(1 - lambda);
  return size < 1 && (options_.modes == KeptModes::kAllStable || size <= nearest);
}

bool ConvergentModeLms::update(const double* Y, const double* tau, const double* dq) noexcept {
  const Eigen::Index n = weight_sqrt_.size(), nb = beta_.size();
  if (!usable_sample(Y, tau, n, nb) || !moving(dq)) return false;
  const RegressorMap H(Y, n, nb);
  for (Eigen::Index j = 0; j < n; ++j) {
    eps_[j] = weight_sqrt_[j] * (tau[j] - H.row(j).dot(beta_));
    A_.row(j) = weight_sqrt_[j] * H.row(j).cwiseProduct(gain_sqrt_.transpose());
    for (Eigen::Index i = 0; i <= j; ++i) G_(j, i) = G_(i, j) = A_.row(i).dot(A_.row(j));
  }
  if (!G_.allFinite()) return false;
  modes_.compute(G_);
  if (modes_.info() != Eigen::Success) return false;

  const double nearest = (1 - modes_.eigenvalues().array()).abs().minCoeff();
  if (!(nearest < 1)) return false;
  // The kept part of eps: the projection onto the kept eigenvectors u of A'A.
  along_.setZero();
  double eigenvalue = 1;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double lambda = modes_.eigenvalues()[i];
    if (!kept(lambda, nearest)) continue;
    along_ += modes_.eigenvectors().col(i).dot(eps_) * modes_.eigenvectors().col(i);
    if (std::abs(1 - lambda) <= nearest) eigenvalue = 1 - lambda;
  }
  candidate_.setZero();
  for (Eigen::Index j = 0; j < n; ++j) candidate_ += along_[j] * A_.row(j).transpose();
  candidate_ = beta_ + gain_sqrt_.cwiseProduct(candidate_);
  if (!candidate_.allFinite()) return false;
  beta_.swap(candidate_);
  mode_eigenvalue_ = eigenvalue;
  ++samples_;
  return true;
}

}  // namespace dyngen::runtime
