// SPDX-License-Identifier: MIT
#include "tests/fleet/fleet_recordings.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace dyngen::test {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kTwoPi = 6.283185307179586;

MatrixXd noise(Index rows, Index columns, double deviation, std::mt19937& random) {
  std::normal_distribution<double> normal(0, deviation);
  return MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

}  // namespace

Eigen::VectorXd fleet_parameters(const runtime::LinearModel& model) {
  VectorXd beta(model.size());
  for (int i = 0; i < model.size(); ++i) {
    beta[i] = model.parameters[static_cast<std::size_t>(i)].value.value_or(0.5 + 0.25 * (i % 7));
  }
  return beta;
}

runtime::Recording fleet_recording(const runtime::LinearModel& model, unsigned seed,
                                   const FleetMotion& motion) {
  constexpr int kSines = 5;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> frequency(0.05, 1.0), phase(0, kTwoPi);
  const Index samples = std::lround(motion.seconds * motion.rate), n = model.joints();
  runtime::Recording recording;
  recording.run_starts = {0};
  recording.time =
      VectorXd::NullaryExpr(samples, [&](Index i) { return static_cast<double>(i) / motion.rate; });
  recording.q = MatrixXd::Zero(samples, n);
  MatrixXd dq = recording.q, ddq = recording.q;
  for (Index j = 0; j < n; ++j) {
    for (int k = 0; k < kSines; ++k) {
      const double w = kTwoPi * frequency(random), start = phase(random);
      const Eigen::ArrayXd angle = w * recording.time.array() + start;
      recording.q.col(j).array() += motion.amplitude * angle.sin();
      dq.col(j).array() += motion.amplitude * w * angle.cos();
      ddq.col(j).array() -= motion.amplitude * w * w * angle.sin();
    }
  }
  recording.tau = MatrixXd(samples, n);
  const VectorXd beta = fleet_parameters(model);
  constexpr Index kBlock = 4096;
  for (Index i = 0; i < samples; i += kBlock) {
    const Index count = std::min(kBlock, samples - i);
    recording.tau.middleRows(i, count) = model.torque(
        recording.q.middleRows(i, count), dq.middleRows(i, count), ddq.middleRows(i, count), beta);
  }
  recording.tau += noise(samples, n, motion.torque_noise, random);
  recording.q += noise(samples, n, motion.position_noise, random);
  return recording;
}

}  // namespace dyngen::test
