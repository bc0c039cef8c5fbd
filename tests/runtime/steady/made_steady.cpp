// SPDX-License-Identifier: MIT
#include "tests/runtime/steady/made_steady.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace dyngen::runtime::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Position and speed over time, sample by sample.
struct Way {
  std::vector<double> q, dq, ddq;

  /// A trapezoid of the speed with corners of 0.2 s, then a pause.
  void stroke(double from, double to, double speed, double step) {
    constexpr double kRamp = 0.2, kPause = 0.3;
    const double way = to > from ? 1 : -1, distance = std::abs(to - from);
    const double whole = distance / speed + kRamp;
    const auto count = static_cast<Index>(std::ceil((whole + kPause) / step));
    for (Index k = 0; k < count; ++k) {
      const double t = static_cast<double>(k) * step;
      const auto ramped = [&](double s) {
        if (s <= 0) return std::array<double, 3>{0, 0, 0};
        if (s >= kRamp) return std::array<double, 3>{speed * (s - kRamp / 2), speed, 0};
        const double w = std::numbers::pi / kRamp;
        return std::array<double, 3>{speed / 2 * (s - std::sin(w * s) / w),
                                     speed / 2 * (1 - std::cos(w * s)),
                                     speed / 2 * w * std::sin(w * s)};
      };
      const auto up = ramped(t), down = ramped(t - (whole - kRamp));
      q.push_back(from + way * (up[0] - down[0]));
      dq.push_back(way * (up[1] - down[1]));
      ddq.push_back(way * (up[2] - down[2]));
    }
  }
};

}  // namespace

MadeNoise pink_noise() {
  MadeNoise noise;
  noise.memory.clear();
  noise.deviation.clear();
  for (double memory = 0.03; memory < 60; memory *= 2) {
    noise.memory.push_back(memory);
    noise.deviation.push_back(0.08);
  }
  return noise;
}

VectorXd noise_of(const MadeNoise& noise, Index samples, double sample_time, std::mt19937& random) {
  std::normal_distribution<double> normal(0, 1);
  VectorXd sum = VectorXd::Zero(samples);
  for (std::size_t i = 0; i < noise.memory.size(); ++i) {
    const double pole = std::exp(-sample_time / noise.memory[i]);
    double x = noise.deviation[i] * normal(random);
    for (Index k = 0; k < samples; ++k) {
      sum[k] += x;
      x = pole * x + std::sqrt(1 - pole * pole) * noise.deviation[i] * normal(random);
    }
  }
  for (double& x : sum) x += noise.white * normal(random);
  return sum;
}

std::shared_ptr<const Recording> made_recording(const MadeJoint& joint, unsigned seed) {
  std::mt19937 random(seed);
  Way way;
  constexpr double kLongest = 2.5, kPosture = 0.4;
  for (const double speed : joint.speeds) {
    const double half = 0.5 * std::min(kLongest, speed * joint.seconds);
    const int passes = std::clamp(static_cast<int>(joint.seconds * speed / kLongest), 1, 4);
    if (!way.q.empty()) way.stroke(way.q.back(), kPosture - half, 0.4, joint.sample_time);
    for (int pass = 0; pass < passes; ++pass) {
      way.stroke(kPosture - half, kPosture + half, speed, joint.sample_time);
      way.stroke(kPosture + half, kPosture - half, speed, joint.sample_time);
    }
  }
  const auto samples = static_cast<Index>(way.q.size());
  auto recording = std::make_shared<Recording>();
  recording->file_name = "made";
  recording->time =
      VectorXd::LinSpaced(samples, 0, static_cast<double>(samples - 1) * joint.sample_time);
  recording->q.resize(samples, 2);
  recording->tau.resize(samples, 2);
  recording->run_starts = {0};
  std::normal_distribution<double> normal(0, 1);
  const VectorXd noise = noise_of(joint.noise, samples, joint.sample_time, random);
  for (Index k = 0; k < samples; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double q = way.q[at], dq = way.dq[at];
    recording->q(k, 0) = q + joint.position_noise * normal(random);
    recording->q(k, 1) = 0.3 + joint.position_noise * normal(random);
    recording->tau(k, 0) = joint.cosine * std::cos(q) + joint.sine * std::sin(q) + joint.offset +
                           1.5 * way.ddq[at] + (dq == 0 ? 0 : joint.friction(dq)) + noise[k];
    recording->tau(k, 1) = 0;
  }
  return recording;
}

}  // namespace dyngen::runtime::test
