// SPDX-License-Identifier: MIT
#include "tests/blind/simulation/noise.h"

#include <array>
#include <cmath>

namespace blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd autoregressive(Index samples, double memory, Random& random) {
  VectorXd series(samples);
  double value = random.normal();
  for (Index k = 0; k < samples; ++k) {
    series[k] = value;
    value = memory * value + std::sqrt(1 - memory * memory) * random.normal();
  }
  return series;
}

/// Nearly 1/f over three decades: autoregressions a decade of time constants apart.
VectorXd pink(Index samples, Random& random) {
  VectorXd series = VectorXd::Zero(samples);
  constexpr std::array<double, 4> kMemory = {0.3, 0.9, 0.99, 0.999};
  for (const double memory : kMemory) series += autoregressive(samples, memory, random) / 2;
  return series;
}

}  // namespace

Eigen::MatrixXd torque_noise(const Noise& noise, Index samples, Random random) {
  Eigen::MatrixXd all(samples, noise.deviation.size());
  for (Index j = 0; j < all.cols(); ++j) {
    VectorXd series;
    switch (noise.colour) {
      case Colour::kWhite:
        series = autoregressive(samples, 0, random);
        break;
      case Colour::kAutoregressive:
        series = autoregressive(samples, noise.memory, random);
        break;
      case Colour::kMixed:
        series =
            (autoregressive(samples, 0, random) + autoregressive(samples, noise.memory, random)) /
            std::sqrt(2.0);
        break;
      case Colour::kPink:
        series = pink(samples, random);
        break;
    }
    all.col(j) = noise.deviation[j] * series;
  }
  return all;
}

}  // namespace blind
