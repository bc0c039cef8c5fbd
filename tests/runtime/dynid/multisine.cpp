// SPDX-License-Identifier: MIT
#include "tests/runtime/dynid/multisine.h"

#include <cmath>
#include <random>

namespace dyngen::test {

using Eigen::Index;
using Eigen::MatrixXd;

runtime::Recording multisine(const runtime::LinearModel& model, const Eigen::VectorXd& beta,
                             const MultisineOptions& options) {
  constexpr int kLines = 8;
  std::mt19937_64 random(options.seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal;
  const Index samples = static_cast<Index>(std::llround(options.seconds / options.sample_time));
  const Index n = model.joints();
  runtime::Recording recording;
  recording.file_name = "multisine";
  recording.time = Eigen::VectorXd::NullaryExpr(
      samples, [&](Index k) { return static_cast<double>(k) * options.sample_time; });
  recording.q = MatrixXd::Zero(samples, n);
  recording.dq = recording.ddq = recording.q;
  for (Index j = 0; j < n; ++j) {
    const bool revolute = model.revolute[static_cast<std::size_t>(j)];
    const double centre = revolute ? 2 * uniform(random) - 1 : 0;
    recording.q.col(j).setConstant(centre);
    for (int line = 1; line <= kLines; ++line) {
      const double omega = 2 * 3.14159265358979323846 * line / options.period;
      const double size =
          options.size * (revolute ? 0.6 : 0.1) * (0.5 + uniform(random)) / std::sqrt(line);
      const double phase = 6.283 * uniform(random);
      const auto angle = (omega * recording.time.array() + phase).eval();
      recording.q.col(j).array() += size * angle.sin();
      recording.dq.col(j).array() += size * omega * angle.cos();
      recording.ddq.col(j).array() -= size * omega * omega * angle.sin();
    }
  }
  recording.tau = model.torque(recording.q, recording.dq, recording.ddq, beta);
  for (double& value : recording.tau.reshaped()) value += options.torque_noise * normal(random);
  if (options.encoder_step > 0) {
    recording.q = (recording.q.array() / options.encoder_step).round() * options.encoder_step;
  }
  recording.run_starts = {0};
  return recording;
}

Eigen::VectorXd plausible_beta(const runtime::LinearModel& model, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  Eigen::VectorXd beta(model.size());
  for (int i = 0; i < model.size(); ++i) {
    const double x = uniform(random);
    switch (model.parameters[static_cast<std::size_t>(i)].kind) {
      case runtime::ParameterKind::kInertial:
        beta[i] = x;
        break;
      case runtime::ParameterKind::kOffset:
        beta[i] = 0.3 * x;
        break;
      default:
        beta[i] = 0.5 + std::abs(x);
    }
  }
  return beta;
}

}  // namespace dyngen::test
