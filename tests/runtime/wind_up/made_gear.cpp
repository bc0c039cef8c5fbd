// SPDX-License-Identifier: MIT
#include "tests/runtime/wind_up/made_gear.h"

#include <array>
#include <cmath>
#include <numbers>

namespace dyngen::test {
namespace {

constexpr std::array<double, 4> kHz = {0.13, 0.29, 0.47, 0.83};

struct Waves {
  std::array<double, 4> size{}, phase{};

  /// Its derivative of an order at a time.
  [[nodiscard]] double at(double t, int derivative) const {
    double sum = 0;
    for (std::size_t i = 0; i < kHz.size(); ++i) {
      const double w = 2 * std::numbers::pi * kHz[i];
      sum += size[i] * std::pow(w, derivative) *
             std::sin(w * t + phase[i] + derivative * std::numbers::pi / 2);
    }
    return sum;
  }
};

Waves waves(double size, std::mt19937& random) {
  std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
  Waves own;
  for (std::size_t i = 0; i < kHz.size(); ++i) {
    own.size[i] = size / (1 + static_cast<double>(i));
    own.phase[i] = angle(random);
  }
  return own;
}

}  // namespace

runtime::WindUpData made_wind_up(const MadeGear& gear, std::mt19937& random) {
  const auto samples = static_cast<Eigen::Index>(gear.seconds * gear.rate);
  const Waves position = waves(0.35, random), other = waves(60, random);
  std::normal_distribution<double> normal(0, 1);
  const auto load_at = [&](double t) {
    if (gear.by_position) return 80 * std::sin(position.at(t, 0));
    return 40 * position.at(t, 2) + other.at(t, 0) + gear.bias;  // inertia, and other joints
  };
  runtime::WindUpData data;
  data.sample_time = 1 / gear.rate;
  data.bandwidth = 10;
  for (auto* own : {&data.wind_up, &data.q, &data.dq, &data.ddq, &data.load}) own->resize(samples);
  double most = 0, range = 0;
  for (Eigen::Index k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) / gear.rate;
    most = std::max(most, std::abs(load_at(t)));
    range = std::max(range, std::abs(position.at(t, 0)));
  }
  double memory = 0;
  const double fresh = std::sqrt(1 - gear.noise_memory * gear.noise_memory);
  for (Eigen::Index k = 0; k < samples; ++k) {
    const double t = static_cast<double>(k) / gear.rate, late = t - gear.delay;
    const double q = position.at(t, 0), then = position.at(late, 0);
    const double load = load_at(late);
    memory = gear.noise_memory * memory + fresh * normal(random);
    const double s = then / range;
    const double twist = gear.compliance * load + gear.hardening * load * load * load +
                         gear.gap / 2 * std::tanh(load / (0.03 * most)) +
                         gear.hysteresis / 2 * (position.at(late, 1) > 0 ? 1 : -1) +
                         gear.error * std::sin(gear.order * then) + gear.slow_error * s * s * s;
    data.q[k] = q;
    data.dq[k] = position.at(t, 1);
    data.ddq[k] = position.at(t, 2);
    data.load[k] = load_at(t) + gear.rotor * data.ddq[k];
    data.wind_up[k] = q - (then - twist) + gear.offset + gear.noise * memory;
  }
  data.rotor_open = gear.rotor != 0;
  return data;
}

}  // namespace dyngen::test
