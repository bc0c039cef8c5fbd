// SPDX-License-Identifier: MIT
#include "runtime/recursive/rls.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace dyngen::runtime {
namespace {

/// Of a diagonal entry of Rt against its column: below it, rounding is all that is left.
constexpr double kRank = 1e-12;
/// Entries of Rt below it are 0: forgetting shall not lead to denormal numbers, which are slow.
constexpr double kTinyGain = 1e-145;

[[noreturn]] void fail(const std::string& what) {
  throw std::invalid_argument("RlsOptions: " + what);
}

void check_vector(const char* name, const Eigen::VectorXd& values, Eigen::Index size,
                  bool positive) {
  if (values.size() == 0) return;
  if (values.size() != size || !values.allFinite() || (positive && values.minCoeff() <= 0)) {
    fail(fmt::format("{} has {} values, expected {} {} ones (or none)", name, values.size(), size,
                     positive ? "positive" : "finite"));
  }
}

/// Upper triangle Rt, its diagonal positive, with Rt'Rt = P^-1.
Eigen::MatrixXd information_root(const Eigen::MatrixXd& P) {
  const Eigen::Index nb = P.rows();
  const Eigen::LLT<Eigen::MatrixXd> llt(P);
  const Eigen::MatrixXd inverse = llt.matrixL().solve(Eigen::MatrixXd::Identity(nb, nb));
  Eigen::MatrixXd Rt =
      Eigen::HouseholderQR<Eigen::MatrixXd>(inverse).matrixQR().triangularView<Eigen::Upper>();
  for (Eigen::Index i = 0; i < nb; ++i) {
    if (Rt(i, i) < 0) Rt.row(i) *= -1;
  }
  return Rt;
}

}  // namespace

void RlsOptions::validate(int joints, int parameters) const {
  if (joints < 1 || parameters < 1) {
    fail(fmt::format("{} joints and {} parameters, expected 1 or more", joints, parameters));
  }
  if (!(forgetting > 0 && forgetting <= 1)) {
    fail(fmt::format("forgetting = {}, expected above 0 and not above 1", forgetting));
  }
  check_vector("noise_stddev", noise_stddev, joints, true);
  check_vector("prior_mean", prior_mean, parameters, false);
  check_vector("max_stddev", max_stddev, parameters, true);
  const Eigen::MatrixXd& P = prior_covariance;
  if (P.size() == 0) return;
  if (P.rows() != parameters || P.cols() != parameters) {
    fail(fmt::format("prior_covariance is {} x {}, expected {} x {}", P.rows(), P.cols(),
                     parameters, parameters));
  }
  if (!P.allFinite() || !P.isApprox(P.transpose(), 1e-12) || P.llt().info() != Eigen::Success) {
    fail("prior_covariance is not symmetric and positive definite");
  }
}

Rls::Rls(int joints, int parameters, const RlsOptions& options) {
  options.validate(joints, parameters);
  const Eigen::Index n = joints, nb = parameters;
  inverse_stddev_ = options.noise_stddev.size() != 0
                        ? Eigen::VectorXd(options.noise_stddev.cwiseInverse())
                        : Eigen::VectorXd::Ones(n);
  sqrt_forgetting_ = std::sqrt(options.forgetting);
  if (options.forgetting < 1 && options.max_stddev.size() != 0) {
    // Between two equations of its own a parameter keeps f = forgetting^nb of its information:
    // with weight w^2 = (1 - f) / f / max^2, w^2 f / (1 - f) = 1 / max^2 is the least it ever has.
    const double f = std::pow(options.forgetting, static_cast<double>(nb));
    hold_ = std::sqrt((1 - f) / f) * options.max_stddev.cwiseInverse();
    if (!hold_.allFinite()) fail("forgetting is too fast for max_stddev");
  }
  beta_ = options.prior_mean.size() != 0 ? options.prior_mean
                                         : Eigen::VectorXd(Eigen::VectorXd::Zero(nb));
  Rt_.setZero(nb, nb);
  if (options.prior_covariance.size() != 0) {
    Rt_ = information_root(options.prior_covariance);
    started_ = determined_ = true;
  }
  z_.setZero(nb);
  next_Rt_ = Rt_;
  next_z_ = z_;
  next_beta_ = beta_;
  const Eigen::Index rows = n + (hold_.size() != 0 ? 1 : 0);
  X_.setZero(rows, nb);
  x_.setZero(rows);
  products_.setZero(nb);
  lengths_.setZero(nb);
  delta_.setZero(nb);
}

/// The forgotten root, and the rows of the sample: residuals on the right, as z is relative to
/// beta.
void Rls::load(const double* Y, const double* tau) noexcept {
  const Eigen::Index n = inverse_stddev_.size(), nb = beta_.size();
  const RegressorMap H(Y, n, nb);
  if (sqrt_forgetting_ < 1) {
    for (Eigen::Index i = 0; i < nb; ++i) {
      const auto faded = sqrt_forgetting_ * Rt_.row(i).tail(nb - i).array();
      next_Rt_.row(i).tail(nb - i) = (faded.abs() > kTinyGain).select(faded, 0.0);
    }
    next_z_ = sqrt_forgetting_ * z_;
  } else {
    next_Rt_ = Rt_;
    next_z_ = z_;
  }
  for (Eigen::Index j = 0; j < n; ++j) {
    X_.row(j) = inverse_stddev_[j] * H.row(j);
    x_[j] = inverse_stddev_[j] * (tau[j] - H.row(j).dot(beta_));
  }
  next_turn_ = turn_;
  if (hold_.size() != 0) {
    X_.row(n).setZero();
    X_(n, turn_) = hold_[turn_];
    x_[n] = 0;
    next_turn_ = (turn_ + 1) % nb;
  }
}

/// Reflects the new rows into the triangle, column by column: (R_ii, x) becomes (mu, 0).
void Rls::reflect() noexcept {
  const Eigen::Index rows = X_.rows(), nb = beta_.size();
  for (Eigen::Index i = 0; i < nb; ++i) {
    const double below = X_.col(i).squaredNorm();
    if (!(below > kTinyGain * kTinyGain)) continue;  // this joint does not feel this parameter
    const double r = next_Rt_(i, i);
    const double mu = std::sqrt(r * r + below);
    const double v = -below / (r + mu);  // r - mu without cancellation
    const double scale = 2 / (v * v + below);
    next_Rt_(i, i) = mu;
    const double s = scale * (v * next_z_[i] + X_.col(i).dot(x_));
    next_z_[i] -= v * s;
    x_ -= s * X_.col(i);
    const Eigen::Index rest = nb - i - 1;
    if (rest == 0) break;
    auto products = products_.head(rest);
    products = v * next_Rt_.row(i).tail(rest);
    for (Eigen::Index j = 0; j < rows; ++j) {
      if (X_(j, i) != 0) products += X_(j, i) * X_.row(j).tail(rest);
    }
    products *= scale;
    next_Rt_.row(i).tail(rest) -= v * products;
    for (Eigen::Index j = 0; j < rows; ++j) {
      if (X_(j, i) != 0) X_.row(j).tail(rest) -= X_(j, i) * products;
    }
  }
}

/// beta += Rt^-1 z, but for parameters about which there is no information: these keep their z.
void Rls::solve() noexcept {
  const Eigen::Index nb = beta_.size();
  lengths_.setZero();
  for (Eigen::Index i = 0; i < nb; ++i) {
    lengths_.tail(nb - i).array() += next_Rt_.row(i).tail(nb - i).array().square();
  }
  next_determined_ = true;
  for (Eigen::Index i = 0; i < nb && next_determined_; ++i) {
    next_determined_ = next_Rt_(i, i) > kRank * std::sqrt(lengths_[i]);
  }
  next_started_ = started_ || next_determined_;
  next_beta_ = beta_;
  if (!next_started_) return;
  for (Eigen::Index i = nb - 1; i >= 0; --i) {
    const Eigen::Index rest = nb - i - 1;
    double value = next_z_[i];
    if (rest > 0) value -= next_Rt_.row(i).tail(rest).dot(delta_.tail(rest));
    const double r = next_Rt_(i, i);
    const bool known = r > kRank * std::sqrt(lengths_[i]);
    delta_[i] = known ? value / r : 0.0;
    next_z_[i] = known ? 0.0 : value;
  }
  next_beta_ += delta_;
}

bool Rls::update(const double* Y, const double* tau) noexcept {
  if (!usable_sample(Y, tau, inverse_stddev_.size(), beta_.size())) return false;
  load(Y, tau);
  reflect();
  solve();
  if (!next_beta_.allFinite() || !next_z_.allFinite() || !next_Rt_.allFinite()) return false;
  Rt_.swap(next_Rt_);
  z_.swap(next_z_);
  beta_.swap(next_beta_);
  turn_ = next_turn_;
  started_ = next_started_;
  determined_ = next_determined_;
  ++samples_;
  return true;
}

Eigen::MatrixXd Rls::covariance() const {
  const Eigen::Index nb = beta_.size();
  if (!determined_) {
    return Eigen::MatrixXd::Constant(nb, nb, std::numeric_limits<double>::quiet_NaN());
  }
  const Eigen::MatrixXd inverse =
      Rt_.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(nb, nb));
  return inverse * inverse.transpose();
}

}  // namespace dyngen::runtime
