// SPDX-License-Identifier: MIT
#include "runtime/control/linearised_error.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

void check_square(const char* function, const char* name, const MatrixXd& matrix, Index joints) {
  if (matrix.rows() == joints && matrix.cols() == joints) return;
  throw std::invalid_argument(fmt::format("{}(): {} is {} x {}, expected {} x {}", function, name,
                                          matrix.rows(), matrix.cols(), joints, joints));
}

void check_positive(const char* function, const Gains& gains) {
  gains.validate(static_cast<int>(gains.kp.size()));
  if (gains.kp.size() < 1 || !(gains.kp.array() > 0).all() || !(gains.kd.array() > 0).all()) {
    throw std::invalid_argument(fmt::format("{}(): a gain is not positive", function));
  }
}

/// The smallest |p(x + i w) / c(x + i w)| on a vertical line, and where.
struct LineMinimum {
  double ratio = 0, speed = 0;
};

/// With y = w^2 the square of the ratio is (y^2 + b y + a^2) / (c^2 + kd^2 y): its derivative has
/// one root y >= 0 at most.
LineMinimum minimum_on_line(double kp, double kd, double x) {
  const double a = x * x + kd * x + kp, c = kp + kd * x, d = kd * kd;
  const double b = (2 * x + kd) * (2 * x + kd) - 2 * a;
  const auto square = [&](double y) { return (y * y + b * y + a * a) / (c * c + d * y); };
  const double discriminant = c * c * c * c - d * (b * c * c - d * a * a);
  double y = 0;
  if (discriminant > 0) y = std::max(0.0, (std::sqrt(discriminant) - c * c) / d);
  // c = 0 on the real axis alone: the ratio is infinite there, and p / c grows with w
  if (c * c + d * y == 0) return {std::numeric_limits<double>::infinity(), 0};
  return {std::sqrt(std::max(0.0, square(y))), std::sqrt(y)};
}

/// Of p: -kd / 2 or the slower of two real roots.
double slowest_root(double kp, double kd) {
  const double discriminant = kd * kd / 4 - kp;
  return -kd / 2 + (discriminant > 0 ? std::sqrt(discriminant) : 0);
}

}  // namespace

MatrixXd inertia_error(const MatrixXd& M, const MatrixXd& M_hat) {
  check_square("inertia_error", "M", M, M.rows());
  check_square("inertia_error", "M_hat", M_hat, M.rows());
  const Eigen::LLT<MatrixXd> factor(M);
  if (factor.info() != Eigen::Success) {
    throw std::invalid_argument("inertia_error(): M is not positive definite");
  }
  return factor.solve(M_hat) - MatrixXd::Identity(M.rows(), M.rows());
}

Eigen::VectorXcd error_eigenvalues(const Gains& gains, const MatrixXd& E) {
  const Index n = gains.kp.size();
  gains.validate(static_cast<int>(n));
  check_square("error_eigenvalues", "E", E, n);
  const MatrixXd gain = MatrixXd::Identity(n, n) + E;
  MatrixXd A = MatrixXd::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n).setIdentity();
  A.bottomLeftCorner(n, n) = -gain * gains.kp.asDiagonal();
  A.bottomRightCorner(n, n) = -gain * gains.kd.asDiagonal();
  return A.eigenvalues();
}

double inclusion_margin(const Gains& gains, const MatrixXd& bound, int joint,
                        std::complex<double> s) {
  const Index n = gains.kp.size();
  check_square("inclusion_margin", "bound", bound, n);
  if (joint < 0 || joint >= n) {
    throw std::invalid_argument(
        fmt::format("inclusion_margin(): joint is {}, expected 0 to {}", joint, n - 1));
  }
  double radius = 0;
  for (Index k = 0; k < n; ++k) radius += bound(joint, k) * std::abs(gains.kd[k] * s + gains.kp[k]);
  return radius - std::abs(s * s + gains.kd[joint] * s + gains.kp[joint]);
}

double inclusion_margin(const Gains& gains, const MatrixXd& bound, std::complex<double> s) {
  double margin = -std::numeric_limits<double>::infinity();
  for (int j = 0; j < static_cast<int>(gains.kp.size()); ++j) {
    margin = std::max(margin, inclusion_margin(gains, bound, j, s));
  }
  return margin;
}

SurvivedError largest_survived_error(const Gains& gains) {
  check_positive("largest_survived_error", gains);
  SurvivedError result;
  result.norm = std::numeric_limits<double>::infinity();
  for (Index j = 0; j < gains.kp.size(); ++j) {
    const LineMinimum minimum = minimum_on_line(gains.kp[j], gains.kd[j], 0);
    if (minimum.ratio < result.norm) {
      result = {minimum.ratio, static_cast<int>(j), minimum.speed};
    }
  }
  return result;
}

double guaranteed_decay(const Gains& gains, double norm) {
  check_positive("guaranteed_decay", gains);
  if (!(norm >= 0)) {
    throw std::invalid_argument(
        fmt::format("guaranteed_decay(): norm is {}, expected 0 or more", norm));
  }
  double decay = std::numeric_limits<double>::infinity();
  for (Index j = 0; j < gains.kp.size(); ++j) {
    const double kp = gains.kp[j], kd = gains.kd[j];
    // {|p / c| <= norm} is bounded and each piece of it has a root of p (maximum principle), so a
    // line right of all roots that meets no piece has all of them on its left.
    double certain = 0, beyond = -slowest_root(kp, kd);
    if (minimum_on_line(kp, kd, 0).ratio <= norm) return 0;
    for (int k = 0; k < 100; ++k) {
      const double middle = (certain + beyond) / 2;
      (minimum_on_line(kp, kd, -middle).ratio > norm ? certain : beyond) = middle;
    }
    decay = std::min(decay, certain);
  }
  return decay;
}

}  // namespace dyngen::runtime
