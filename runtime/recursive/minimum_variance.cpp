// SPDX-License-Identifier: MIT
#include "runtime/recursive/minimum_variance.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <stdexcept>
#include <string>

namespace dyngen::runtime {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("MinimumVarianceOptions: " + what);
}

void check_positive(const char* name, const Eigen::MatrixXd& P) {
  if (P.size() == 0 || P.rows() != P.cols() || !P.allFinite() ||
      !P.isApprox(P.transpose(), 1e-12) || P.llt().info() != Eigen::Success) {
    refuse(fmt::format("{} ({} x {}) is not square, symmetric and positive definite", name,
                       P.rows(), P.cols()));
  }
}

const MinimumVarianceOptions& checked(const MinimumVarianceOptions& options) {
  options.validate();
  return options;
}

Eigen::MatrixXd walk_of(const MinimumVarianceOptions& options) {
  if (options.walk_covariance.size() != 0) return options.walk_covariance;
  return 0 * options.prior_covariance;
}

Eigen::VectorXd mean_of(const MinimumVarianceOptions& options) {
  if (options.prior_mean.size() != 0) return options.prior_mean;
  return Eigen::VectorXd::Zero(options.prior_covariance.rows());
}

}  // namespace

void MinimumVarianceOptions::validate() const {
  check_positive("prior_covariance", prior_covariance);
  check_positive("measurement_covariance", measurement_covariance);
  const Eigen::Index nb = prior_covariance.rows();
  if (prior_mean.size() != 0 && (prior_mean.size() != nb || !prior_mean.allFinite())) {
    refuse(fmt::format("prior_mean has {} values, expected {} finite ones (or none)",
                       prior_mean.size(), nb));
  }
  if (walk_covariance.size() != 0) {
    if (walk_covariance.rows() != nb) {
      refuse(fmt::format("walk_covariance is {} x {}, expected {} x {}", walk_covariance.rows(),
                         walk_covariance.cols(), nb, nb));
    }
    (void)UdCovariance("MinimumVarianceOptions: walk_covariance", walk_covariance);
  }
}

MinimumVariance::MinimumVariance(const MinimumVarianceOptions& options)
    : C_("prior_covariance", checked(options).prior_covariance),
      next_C_(C_),
      Q_("walk_covariance", walk_of(options)),
      walks_(Q_.D().maxCoeff() > 0),
      L_(options.measurement_covariance.llt().matrixL()),
      beta_(mean_of(options)),
      next_beta_(beta_) {
  H_.setZero(L_.rows(), beta_.size());
  z_.setZero(L_.rows());
}

bool MinimumVariance::update(const double* Y, const double* tau) noexcept {
  const Eigen::Index n = L_.rows(), nb = beta_.size();
  if (!usable_sample(Y, tau, n, nb)) return false;
  const RegressorMap given(Y, n, nb);
  next_C_.assign(C_);
  if (walks_ && samples_ > 0) next_C_.add(Q_);
  next_beta_ = beta_;
  double squared = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    // Row j of L^-1 Y, by forward substitution: noise of variance 1, independent of the rows
    // before.
    H_.row(j) = given.row(j);
    z_[j] = tau[j];
    for (Eigen::Index i = 0; i < j; ++i) {
      if (L_(j, i) == 0) continue;
      H_.row(j) -= L_(j, i) * H_.row(i);
      z_[j] -= L_(j, i) * z_[i];
    }
    H_.row(j) /= L_(j, j);
    z_[j] /= L_(j, j);
    const double innovation = z_[j] - H_.row(j).dot(next_beta_);
    const double variance = next_C_.measure(H_.row(j).data(), 1.0, innovation, next_beta_);
    squared += innovation * innovation / variance;
  }
  if (!next_beta_.allFinite() || !next_C_.all_finite() || !std::isfinite(squared)) return false;
  C_.swap(next_C_);
  beta_.swap(next_beta_);
  innovation_squared_ = squared;
  ++samples_;
  return true;
}

}  // namespace dyngen::runtime
