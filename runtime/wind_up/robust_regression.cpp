// SPDX-License-Identifier: MIT
#include "runtime/wind_up/robust_regression.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/estimation/distributions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Of a symmetric matrix, after its columns were scaled to unit norm.
MatrixXd pseudo_inverse(const MatrixXd& products) {
  constexpr double kLeast = 1e-10;  // of the largest eigenvalue: a root of it of a column is new
  const VectorXd scale =
      products.diagonal().unaryExpr([](double x) { return x > 0 ? 1 / std::sqrt(x) : 0.0; });
  const MatrixXd scaled = scale.asDiagonal() * products * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled);
  const double least = kLeast * std::max(eigen.eigenvalues().maxCoeff(), 0.0);
  const VectorXd inverse =
      eigen.eigenvalues().unaryExpr([&](double x) { return x > least ? 1 / x : 0.0; });
  return scale.asDiagonal() * eigen.eigenvectors() * inverse.asDiagonal() *
         eigen.eigenvectors().transpose() * scale.asDiagonal();
}

}  // namespace

double RobustRegression::deviation(Index i) const {
  return std::sqrt(std::max(0.0, covariance(i, i)));
}

double RobustRegression::chance(Index i) const {
  const double sd = deviation(i);
  return sd > 0 ? student_tails(std::abs(beta[i]) / sd, degrees) : 1;
}

double RobustRegression::chance(Index first, Index count) const {
  if (degrees <= count) return 1;
  const MatrixXd part = covariance.block(first, first, count, count);
  const Eigen::FullPivLU<MatrixXd> lu(part);
  if (!lu.isInvertible()) return 1;
  const VectorXd own = beta.segment(first, count);
  const double wald = own.dot(lu.solve(own));
  const double m = static_cast<double>(count), b = degrees;
  return variance_ratio_tail((b - m + 1) / b * wald / m, m, b - m + 1);
}

int cosines_for(double independent_rows, double factor) {
  constexpr int kFewest = 4;
  return std::max(kFewest, static_cast<int>(std::lround(factor * std::cbrt(independent_rows) *
                                                        std::cbrt(independent_rows))));
}

RobustRegression robust_regression(const MatrixXd& D, const VectorXd& w, int cosines) {
  RobustRegression fit;
  fit.inverse = pseudo_inverse(D.transpose() * D);
  fit.beta = fit.inverse * (D.transpose() * w);
  fit.residual = w - D * fit.beta;
  fit.degrees = cosines;
  const Index n = D.rows(), k = D.cols();
  const MatrixXd scores = fit.residual.asDiagonal() * (D * fit.inverse);
  MatrixXd sums = MatrixXd::Zero(k, cosines);
  const double step = std::numbers::pi / static_cast<double>(n);
  constexpr Index kRows = 4096;
  for (Index first = 0; first < n; first += kRows) {
    const Index count = std::min(kRows, n - first);
    MatrixXd weights(count, cosines);
    for (Index j = 0; j < cosines; ++j) {
      for (Index i = 0; i < count; ++i) {
        weights(i, j) =
            std::cos(step * static_cast<double>(j + 1) * (static_cast<double>(first + i) + 0.5));
      }
    }
    sums += scores.middleRows(first, count).transpose() * weights;
  }
  fit.covariance = 2.0 / cosines * sums * sums.transpose();
  // what is fitted takes a part of the residual
  if (n > k) fit.covariance *= static_cast<double>(n) / static_cast<double>(n - k);
  return fit;
}

}  // namespace dyngen::runtime
