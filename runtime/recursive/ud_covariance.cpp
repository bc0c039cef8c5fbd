// SPDX-License-Identifier: MIT
#include "runtime/recursive/ud_covariance.h"

#include <fmt/format.h>

#include <stdexcept>

#include "runtime/recursive/sample.h"

namespace dyngen::runtime {

UdCovariance::UdCovariance(const char* name, const Eigen::MatrixXd& P) {
  const auto fail = [&](const char* what) {
    throw std::invalid_argument(fmt::format("{}: {}", name, what));
  };
  const Eigen::Index nb = P.rows();
  if (nb == 0 || P.cols() != nb) fail("not a square matrix");
  if (!P.allFinite() ||
      (P - P.transpose()).cwiseAbs().maxCoeff() > 1e-12 * P.cwiseAbs().maxCoeff()) {
    fail("not finite and symmetric");
  }
  U_ = Eigen::MatrixXd::Identity(nb, nb);
  D_.setZero(nb);
  // From the last column to the first: D_j = P_jj, U_j = P_j / D_j, P -= D_j U_j U_j'.
  Eigen::MatrixXd rest = P;
  for (Eigen::Index j = nb - 1; j >= 0; --j) {
    // Of a semidefinite matrix rounding alone is left, a few nb units of what was there.
    const double rounding = 1e-14 * static_cast<double>(nb) * P(j, j);
    const double d = rest(j, j);
    if (d < -rounding || P(j, j) < 0) fail("not positive semidefinite");
    if (d <= rounding) {
      const auto above = rest.col(j).head(j).cwiseAbs();
      // |P_ij| <= sqrt(P_ii P_jj): a column beside a zero must be zero.
      for (Eigen::Index i = 0; i < j; ++i) {
        if (above[i] * above[i] > 1e-12 * P(i, i) * P(j, j)) fail("not positive semidefinite");
      }
      continue;
    }
    D_[j] = d;
    U_.col(j).head(j) = rest.col(j).head(j) / d;
    rest.topLeftCorner(j, j) -= d * U_.col(j).head(j) * U_.col(j).head(j).transpose();
  }
  f_.setZero(nb);
  v_.setZero(nb);
  gain_.setZero(nb);
  column_.setZero(nb);
}

double UdCovariance::measure(const double* h, double r, double innovation,
                             Eigen::VectorXd& x) noexcept {
  const Eigen::Index nb = D_.size();
  const VectorMap H(h, nb);
  for (Eigen::Index j = 0; j < nb; ++j) {
    f_[j] = H[j] + (j > 0 ? U_.col(j).head(j).dot(H.head(j)) : 0.0);
  }
  v_ = D_.cwiseProduct(f_);
  gain_.setZero();
  double a = r;
  for (Eigen::Index j = 0; j < nb; ++j) {
    if (v_[j] == 0) continue;  // the measurement does not feel this direction
    const double before = a;
    a += v_[j] * f_[j];
    D_[j] *= before / a;
    const double factor = -f_[j] / before;
    // Plain loops here and below: GCC 12 warns of Eigen's, wrongly, for columns of no length.
    double* u = U_.col(j).data();
    double* k = gain_.data();
    const double v = v_[j];
    for (Eigen::Index i = 0; i < j; ++i) {
      const double old = u[i];
      u[i] = old + factor * k[i];
      k[i] += v * old;
    }
    gain_[j] = v;
  }
  x += (innovation / a) * gain_;
  return a;
}

void UdCovariance::add(const UdCovariance& other) noexcept {
  const Eigen::Index nb = D_.size();
  for (Eigen::Index i = 0; i < nb; ++i) {
    double c = other.D_[i];
    if (c <= 0) continue;
    // P += c a a', a = column i of other's U: zero below entry i.
    double* a = column_.data();
    column_ = other.U_.col(i);
    for (Eigen::Index j = i; j >= 0; --j) {
      const double aj = a[j];
      if (aj == 0) continue;
      const double d = D_[j];
      D_[j] = d + c * aj * aj;
      const double b = c * aj / D_[j];
      double* u = U_.col(j).data();
      for (Eigen::Index k = 0; k < j; ++k) {
        a[k] -= aj * u[k];
        u[k] += b * a[k];
      }
      c *= d / D_[j];
      if (c == 0) break;
    }
  }
}

Eigen::MatrixXd UdCovariance::matrix() const {
  const Eigen::MatrixXd half = U_ * D_.cwiseSqrt().asDiagonal();
  return half * half.transpose();
}

void UdCovariance::swap(UdCovariance& other) noexcept {
  U_.swap(other.U_);
  D_.swap(other.D_);
}

void UdCovariance::assign(const UdCovariance& other) noexcept {
  U_ = other.U_;
  D_ = other.D_;
}

}  // namespace dyngen::runtime
