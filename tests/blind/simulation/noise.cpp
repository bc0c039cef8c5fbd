// SPDX-License-Identifier: MIT
#include "tests/blind/simulation/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

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

std::function<double(double t)> wandering(double memory, double from, double to, Random random) {
  const double step = std::clamp(memory / 10, 0.002, 0.02);
  const Index count = static_cast<Index>(std::ceil((to - from) / step)) + 3;
  const auto series =
      std::make_shared<const VectorXd>(autoregressive(count, std::exp(-step / memory), random));
  return [=](double t) {
    const double place = std::clamp((t - from) / step, 0.0, static_cast<double>(count - 1));
    const Index low = std::min<Index>(static_cast<Index>(place), count - 2);
    const double u = place - static_cast<double>(low);  // between values: Catmull and Rom's cubic
    const auto value = [&](Index k) { return (*series)[std::clamp<Index>(k, 0, count - 1)]; };
    const double a = value(low - 1), b = value(low), c = value(low + 1), d = value(low + 2);
    return b + u / 2 * (c - a + u * (2 * a - 5 * b + 4 * c - d + u * (3 * (b - c) + d - a)));
  };
}

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
