// SPDX-License-Identifier: MIT
#include "tests/runtime/ripple/made_ripple.h"

#include <cmath>
#include <numbers>

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kTurn = 2 * std::numbers::pi;

void move_by_sines(const MadeRipple& made, std::mt19937& random, runtime::RippleData& data) {
  std::uniform_real_distribution<double> part(0.8, 1.25), phase(0, kTurn);
  for (const double hz : {0.07, 0.19, 0.43}) {
    const double w = kTurn * hz * part(random), at = phase(random);
    const double a = made.reach / 2 * (hz < 0.1 ? 0.7 : 0.2);
    for (Index k = 0; k < data.q.size(); ++k) {
      const double t = static_cast<double>(k) / made.rate;
      data.q[k] += a * std::sin(w * t + at);
      data.dq[k] += a * w * std::cos(w * t + at);
      data.ddq[k] -= a * w * w * std::sin(w * t + at);
    }
  }
}

void move_by_speeds(const MadeRipple& made, runtime::RippleData& data) {
  constexpr double kSpeed = 1.3;  // rad/s
  double q = 0, direction = 1;
  for (Index k = 0; k < data.q.size(); ++k) {
    data.q[k] = q;
    data.dq[k] = direction * kSpeed;
    q += data.dq[k] / made.rate;
    if (std::abs(q) > made.reach / 2) direction = q > 0 ? -1 : 1;
  }
}

VectorXd noise_of(const MadeRipple& made, std::mt19937& random, Index samples) {
  std::normal_distribution<double> normal(0, 1);
  VectorXd noise(samples);
  double before = 0;
  for (Index k = 0; k < samples; ++k) {
    before = made.memory * before + made.noise * normal(random);
    noise[k] = before;
  }
  return noise;
}

/// x_k = 2 r cos(w) x_(k-1) - r^2 x_(k-2) + noise
VectorXd resonance_of(const MadeRipple& made, std::mt19937& random, Index samples) {
  std::normal_distribution<double> normal(0, 1);
  constexpr double kDamping = 0.005;
  const double w = kTurn * made.resonance_hz / made.rate, r = std::exp(-kDamping * w);
  VectorXd x = VectorXd::Zero(samples);
  for (Index k = 2; k < samples; ++k) {
    x[k] = 2 * r * std::cos(w) * x[k - 1] - r * r * x[k - 2] + normal(random);
  }
  return made.resonance * x / std::sqrt(x.squaredNorm() / static_cast<double>(samples));
}

}  // namespace

RippleTruth made_ripple(const MadeRipple& made, std::mt19937& random) {
  RippleTruth truth;
  runtime::RippleData& data = truth.data;
  const auto samples = static_cast<Index>(made.seconds * made.rate);
  data.sample_time = 1 / made.rate;
  for (VectorXd* part : {&data.q, &data.dq, &data.ddq, &data.residual}) part->setZero(samples);
  if (made.sweep == Sweep::kSines) {
    move_by_sines(made, random, data);
  } else {
    move_by_speeds(made, data);
  }
  if (made.order > 0) {
    VectorXd wave(samples);
    for (Index k = 0; k < samples; ++k) {
      const bool forward = data.dq[k] >= 0;
      const double angle = made.order * data.q[k] - (forward ? made.phase : made.backward_phase);
      const double square = std::pow(made.order * data.dq[k], 2), turn = made.order * data.ddq[k];
      wave[k] = made.position_error ? -(square * std::cos(angle) + turn * std::sin(angle))
                                    : (forward ? 1 : made.backward) * std::cos(angle);
    }
    const VectorXd white = wave.tail(samples - 1) - made.memory * wave.head(samples - 1);
    truth.amplitude = made.noise * std::sqrt(made.lambda / white.squaredNorm());
    data.residual += truth.amplitude * wave;
  }
  data.residual += noise_of(made, random, samples);
  if (made.slow > 0) {
    // as friction that is bent and a gravity that is a little wrong
    data.residual.array() +=
        made.slow * (3 * data.dq.array()).tanh() + made.slow * (1.7 * data.q.array() + 0.4).sin();
  }
  if (made.line > 0) {
    for (Index k = 0; k < samples; ++k) {
      data.residual[k] +=
          made.line * std::cos(kTurn * made.line_hz * static_cast<double>(k) / made.rate);
    }
  }
  if (made.resonance > 0) data.residual += resonance_of(made, random, samples);
  return truth;
}

}  // namespace dyngen::test
