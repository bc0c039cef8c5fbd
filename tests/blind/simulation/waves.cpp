// SPDX-License-Identifier: MIT
// Motions that are waves of some kind, fitted into the arm's limits.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/blind/simulation/motion.h"

namespace blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLead = 1;           // s before the first sample
constexpr double kDifference = 1e-3;  // s
constexpr double kTurn = 2 * std::numbers::pi;

using Curve = std::function<VectorXd(double t)>;

/// Rises from 0 to 1 between u = 0 and 1; velocity and acceleration are 0 at both ends.
double swell(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (-15 + 6 * u));
}

Wanted by_differences(const Curve& path, double t) {
  const VectorXd before = path(t - kDifference), here = path(t), after = path(t + kDifference);
  return {here, (after - before) / (2 * kDifference),
          (after - 2 * here + before) / (kDifference * kDifference)};
}

/// Each joint's path, stretched and moved so that it keeps to the limits.
Motion fitted(const Arm& arm, double duration, const Curve& path, Random& random) {
  const Index n = arm.joints();
  VectorXd low = VectorXd::Constant(n, 1e9), high = -low, speed = VectorXd::Zero(n), push = speed;
  constexpr double kLooksASecond = 100;
  const int looks = static_cast<int>((duration + kLead) * kLooksASecond);
  for (int i = 0; i <= looks; ++i) {
    const Wanted here = by_differences(path, i / kLooksASecond - kLead);
    low = low.cwiseMin(here.q);
    high = high.cwiseMax(here.q);
    speed = speed.cwiseMax(here.dq.cwiseAbs());
    push = push.cwiseMax(here.ddq.cwiseAbs());
  }
  VectorXd size(n), middle(n);
  for (Index j = 0; j < n; ++j) {
    const double room = kRange * (arm.q_max[j] - arm.q_min[j]);
    size[j] = std::min({kSpeed * arm.v_max[j] / speed[j], kAcceleration * arm.a_max[j] / push[j],
                        room / (high[j] - low[j])}) *
              random.between(0.7, 1);
    const double left = room - size[j] * (high[j] - low[j]);
    middle[j] = (arm.q_min[j] + arm.q_max[j] - room) / 2 + left * random.unit() - size[j] * low[j];
  }
  return {duration, false, [=](double t) {
            Wanted wanted = by_differences(path, t);
            wanted.q = middle + size.cwiseProduct(wanted.q);
            wanted.dq = size.cwiseProduct(wanted.dq);
            wanted.ddq = size.cwiseProduct(wanted.ddq);
            return wanted;
          }};
}

struct Wave {
  double size = 1, frequency = 1, phase = 0;  // Hz, rad

  double at(double t) const { return size * std::sin(kTurn * frequency * t + phase); }
};

/// Of each joint.
using Waves = std::vector<std::vector<Wave>>;

VectorXd sum_of(const Waves& waves, double t) {
  VectorXd q = VectorXd::Zero(static_cast<Index>(waves.size()));
  for (std::size_t j = 0; j < waves.size(); ++j) {
    for (const Wave& wave : waves[j]) q[static_cast<Index>(j)] += wave.at(t);
  }
  return q;
}

}  // namespace

Motion irregular_motion(const Arm& arm, double duration, Random random) {
  constexpr int kWaves = 14;
  constexpr double kBend = 0.3;  // Hz: slower waves are equally large
  Waves waves(static_cast<std::size_t>(arm.joints()));
  for (auto& of_joint : waves) {
    for (int i = 0; i < kWaves; ++i) {
      const double f = random.decade(0.05, 1.2);
      of_joint.push_back(
          {random.normal() / (1 + std::pow(f / kBend, 2)), f, random.between(0, kTurn)});
    }
  }
  return fitted(
      arm, duration, [=](double t) { return sum_of(waves, t); }, random);
}

Motion chirps(const Arm& arm, double duration, Random random) {
  constexpr double kFade = 1;  // s
  struct Chirp {
    double first, last;         // Hz
    double range, speed, push;  // rad, rad/s, rad/s^2
  };
  std::vector<Chirp> all;
  for (Index j = 0; j < arm.joints(); ++j) {
    Chirp chirp{random.between(0.1, 0.2), random.between(1, 3),
                kRange * (arm.q_max[j] - arm.q_min[j]) / 2, arm.v_max[j], arm.a_max[j]};
    if (random.chance(0.5)) std::swap(chirp.first, chirp.last);
    all.push_back(chirp);
  }
  const Curve path = [=](double t) {
    VectorXd q = VectorXd::Zero(static_cast<Index>(all.size()));
    const double fade = swell(t / kFade) * swell((duration - t) / kFade);
    t = std::clamp(t, 0.0, duration);
    for (std::size_t j = 0; j < all.size(); ++j) {
      const Chirp& c = all[j];
      const double rise = (c.last - c.first) / duration, w = kTurn * (c.first + rise * t);
      const double size = 1 / (1 / c.range + w / c.speed + w * w / c.push);
      q[static_cast<Index>(j)] = fade * size * std::sin(kTurn * t * (c.first + rise * t / 2));
    }
    return q;
  };
  return fitted(arm, duration, path, random);
}

Motion ramped_motion(const Arm& arm, double duration, int periods, Random random) {
  constexpr int kHarmonics = 5;
  const double rest = random.between(1, 2), ramp = random.between(2, 3);
  const double period = (duration - 2 * rest - 2 * ramp) / periods;
  Waves waves(static_cast<std::size_t>(arm.joints()));
  for (auto& of_joint : waves) {
    for (int h = 1; h <= kHarmonics; ++h) {
      of_joint.push_back({random.normal() / h, h / period, random.between(0, kTurn)});
    }
  }
  const Curve path = [=](double t) {
    const double part = swell((t - rest) / ramp) * swell((duration - rest - t) / ramp);
    return VectorXd(part * sum_of(waves, t));
  };
  return fitted(arm, duration, path, random);
}

}  // namespace blind
