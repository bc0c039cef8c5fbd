// SPDX-License-Identifier: MIT
#include "runtime/estimation/robust_regression.h"

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
MatrixXd scaled_inverse(const MatrixXd& products) {
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

/// A sum of scores is smaller than the noise makes it, because columns were fitted: a sum with the
/// weights c has the variance c'c of white noise, and c'(I - H)c of its residual. Slow columns take
/// much of the slow sums. Every `stride`-th row tells the ratio.
void give_back_fitted(const MatrixXd& D, const MatrixXd& inverse, MatrixXd& sums) {
  constexpr Index kEnough = 4096;
  constexpr double kLeast = 0.05;  // what is left of a sum that is given back
  const Index stride = 1 + D.rows() / kEnough, rows = (D.rows() + stride - 1) / stride;
  const MatrixXd part = D(Eigen::seqN(0, rows, stride), Eigen::all);
  const MatrixXd gains = part * inverse;
  const MatrixXd own = static_cast<double>(stride) * inverse;  // of `part` alone, reversed
  const double step = std::numbers::pi / static_cast<double>(rows);
  for (Index j = 0; j < sums.cols(); ++j) {
    const VectorXd weight = VectorXd::NullaryExpr(rows, [&](Index i) {
      return std::cos(step * static_cast<double>(j + 1) * (static_cast<double>(i) + 0.5));
    });
    const MatrixXd c = weight.asDiagonal() * gains;  // a column for each parameter
    const MatrixXd on_columns = part.transpose() * c;
    const VectorXd whole = c.colwise().squaredNorm();
    const VectorXd fitted = (on_columns.array() * (own * on_columns).array()).colwise().sum();
    for (Index i = 0; i < sums.rows(); ++i) {
      if (!(whole[i] > 0)) continue;
      sums(i, j) /= std::sqrt(std::max(kLeast, 1 - fitted[i] / whole[i]));
    }
  }
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

int cosines_for(double independent_rows) {
  constexpr int kFewest = 4;
  constexpr double kFactor = 0.2;
  const double root = std::cbrt(independent_rows);
  return std::max(kFewest, static_cast<int>(std::lround(kFactor * root * root)));
}

MatrixXd cosine_sums(const MatrixXd& columns, int cosines) {
  const Index n = columns.rows();
  MatrixXd sums = MatrixXd::Zero(columns.cols(), cosines);
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
    sums += columns.middleRows(first, count).transpose() * weights;
  }
  return sums;
}

RobustRegression robust_regression(const MatrixXd& D, const VectorXd& w, int cosines) {
  RobustRegression fit;
  fit.inverse = scaled_inverse(D.transpose() * D);
  fit.beta = fit.inverse * (D.transpose() * w);
  fit.residual = w - D * fit.beta;
  fit.degrees = cosines;
  const MatrixXd scores = fit.residual.asDiagonal() * (D * fit.inverse);
  MatrixXd sums = cosine_sums(scores, cosines);
  give_back_fitted(D, fit.inverse, sums);
  fit.covariance = 2.0 / cosines * sums * sums.transpose();
  return fit;
}

}  // namespace dyngen::runtime
