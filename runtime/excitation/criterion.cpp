// SPDX-License-Identifier: MIT
#include "runtime/excitation/criterion.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// log (sum lambda^p)^(1/p) and its derivatives by every lambda; p may be negative.
struct PowerMean {
  double value = 0;
  ArrayXd slope;
};

PowerMean power_mean(const ArrayXd& lambda, double p) {
  const ArrayXd exponents = p * lambda.log();
  const double largest = exponents.maxCoeff();
  const ArrayXd terms = (exponents - largest).exp();
  const double sum = terms.sum();
  return {(largest + std::log(sum)) / p, terms / (sum * lambda)};
}

/// Of a matrix with these eigenvalues.
PowerMean value_of(const ArrayXd& lambda, const CriterionOptions& options) {
  switch (options.criterion) {
    case Criterion::kCondition: {
      const PowerMean top = power_mean(lambda, options.power);
      const PowerMean bottom = power_mean(lambda, -options.power);
      return {0.5 * (top.value - bottom.value), 0.5 * (top.slope - bottom.slope)};
    }
    case Criterion::kDeterminant: {
      const double size = static_cast<double>(lambda.size());
      return {-lambda.log().sum() / size, -lambda.inverse() / size};
    }
    case Criterion::kTrace:
    case Criterion::kSmallest: {
      const double p = options.criterion == Criterion::kTrace ? 1 : options.power;
      const PowerMean bottom = power_mean(lambda, -p);
      return {-bottom.value, -bottom.slope};
    }
  }
  return {};
}

}  // namespace

void CriterionOptions::validate() const {
  if (!(power >= 1)) {
    throw std::invalid_argument(
        fmt::format("CriterionOptions: power is {}, expected at least 1", power));
  }
}

CriterionValue evaluate(const MatrixXd& R, const CriterionOptions& options) {
  options.validate();
  VectorXd scale = VectorXd::Ones(R.rows());
  if (options.unit_columns) scale = R.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = scale.asDiagonal() * R * scale.asDiagonal();
  CriterionValue result{std::numeric_limits<double>::infinity(),
                        MatrixXd::Zero(R.rows(), R.cols())};
  if (!scaled.allFinite()) return result;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(scaled);
  const ArrayXd lambda = solver.eigenvalues().array();
  // what rounding leaves of a zero eigenvalue is no information
  if (!(lambda.minCoeff() > 1e-15 * lambda.maxCoeff())) return result;
  const PowerMean mean = value_of(lambda, options);
  result.value = mean.value;
  const MatrixXd& V = solver.eigenvectors();
  const MatrixXd own = V * mean.slope.matrix().asDiagonal() * V.transpose();
  result.gradient = scale.asDiagonal() * own * scale.asDiagonal();
  if (options.unit_columns) {
    // the scale of a column depends on R's diagonal
    const VectorXd through_scale = (own * scaled).diagonal().cwiseQuotient(R.diagonal());
    result.gradient.diagonal() -= through_scale;
  }
  return result;
}

}  // namespace dyngen::runtime
