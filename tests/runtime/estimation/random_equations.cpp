// SPDX-License-Identifier: MIT
#include "tests/runtime/estimation/random_equations.h"

#include <cmath>

namespace dyngen::test {

using Eigen::Index;
using Eigen::MatrixXd;

RandomEquations::RandomEquations(int nb, Index samples, std::uint64_t seed) : parameters(nb) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  columns.resize(2);
  for (int c = 0; c < nb; ++c) {
    columns[0].push_back(c);
    if (c >= nb / 2) columns[1].push_back(c);
  }
  truth = Eigen::VectorXd::NullaryExpr(nb, [&](Index) { return normal(random); });
  Y = MatrixXd::Zero(samples, Index{2} * nb);
  for (Index j = 0; j < 2; ++j) {
    for (const int c : columns[static_cast<std::size_t>(j)]) {
      for (int wave = 0; wave < 4; ++wave) {
        const double frequency = 0.002 + 0.05 * uniform(random), phase = 6.3 * uniform(random);
        const double size = normal(random);
        for (Index k = 0; k < samples; ++k) {
          Y(k, j * nb + c) += size * std::sin(frequency * static_cast<double>(k) + phase);
        }
      }
    }
  }
  clean.resize(samples, 2);
  for (Index j = 0; j < 2; ++j) clean.col(j) = Y.middleCols(j * nb, nb) * truth;
}

MatrixXd RandomEquations::noisy(double pole, const Eigen::Vector2d& deviation,
                                std::mt19937_64& random) const {
  std::normal_distribution<double> normal;
  MatrixXd tau = clean;
  const double innovation = std::sqrt(1 - pole * pole);
  for (Index j = 0; j < 2; ++j) {
    double e = normal(random);
    for (Index k = 0; k < tau.rows(); ++k) {
      tau(k, j) += deviation[j] * e;
      e = pole * e + innovation * normal(random);
    }
  }
  return tau;
}

runtime::RowSource RandomEquations::source(const MatrixXd& tau, Index block) const {
  return [this, tau, block](const std::function<void(const runtime::RowBlock&)>& visit) {
    for (Index start = 0; start < tau.rows(); start += block) {
      const Index count = std::min(block, tau.rows() - start);
      visit({Y.middleRows(start, count), tau.middleRows(start, count), {}, start > 0});
    }
  };
}

}  // namespace dyngen::test
