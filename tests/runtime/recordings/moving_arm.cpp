// SPDX-License-Identifier: MIT
#include "tests/runtime/recordings/moving_arm.h"

#include <cmath>

namespace dyngen::test {

double between(double low, double high, std::mt19937& generator) {
  return std::uniform_real_distribution<double>(low, high)(generator);
}

Eigen::Index whole_between(Eigen::Index low, Eigen::Index high, std::mt19937& generator) {
  return std::uniform_int_distribution<Eigen::Index>(low, high)(generator);
}

runtime::Recording moving_arm(const ArmMotion& motion, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  runtime::Recording recording;
  recording.file_name = "run.csv";
  recording.run_starts = {0};
  recording.time.resize(motion.samples);
  recording.q.resize(motion.samples, motion.joints);
  recording.tau.resize(motion.samples, motion.joints);
  for (Eigen::Index k = 0; k < motion.samples; ++k) {
    recording.time(k) = static_cast<double>(k) * motion.sample_time;
    recording.lines.push_back(static_cast<std::uint32_t>(k) + 2);
  }
  constexpr int kSines = 5;
  for (Eigen::Index j = 0; j < motion.joints; ++j) {
    const double middle = between(-1, 1, generator);
    Eigen::VectorXd frequency(kSines), phase(kSines), amplitude(kSines);
    for (int i = 0; i < kSines; ++i) {
      frequency(i) = 2 * M_PI * between(0.1, 1.2, generator);
      phase(i) = between(0, 2 * M_PI, generator);
      amplitude(i) = motion.speed / kSines / frequency(i);
    }
    for (Eigen::Index k = 0; k < motion.samples; ++k) {
      double q = middle, dq = 0, ddq = 0;
      for (int i = 0; i < kSines; ++i) {
        const double angle = frequency(i) * recording.time(k) + phase(i);
        q += amplitude(i) * std::sin(angle);
        dq += amplitude(i) * frequency(i) * std::cos(angle);
        ddq -= amplitude(i) * frequency(i) * frequency(i) * std::sin(angle);
      }
      recording.tau(k, j) = ddq + 8 * std::cos(q) + dq + std::copysign(2.0, dq) +
                            motion.torque_noise * normal(generator);
      q += motion.position_noise * normal(generator);
      if (motion.encoder_step > 0) q = std::round(q / motion.encoder_step) * motion.encoder_step;
      recording.q(k, j) = q;
    }
  }
  return recording;
}

}  // namespace dyngen::test
