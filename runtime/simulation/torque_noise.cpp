// SPDX-License-Identifier: MIT
#include "runtime/simulation/torque_noise.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace dyngen::runtime {

void TorqueNoiseOptions::validate(int joints) const {
  if (deviation.size() != 0 &&
      (deviation.size() != joints || !deviation.allFinite() || (deviation.array() < 0).any())) {
    throw std::invalid_argument(
        fmt::format("TorqueNoise: deviation has {} values, expected {} that are not negative",
                    deviation.size(), joints));
  }
  if (!(coloured_part >= 0 && coloured_part <= 1) || !(pole >= 0 && pole < 1)) {
    throw std::invalid_argument(
        fmt::format("TorqueNoise: coloured_part is {}, pole {}, expected 0 to 1, and a pole below "
                    "1",
                    coloured_part, pole));
  }
}

TorqueNoise::TorqueNoise(const TorqueNoiseOptions& options, int joints, std::uint64_t seed)
    : options_(options), random_(seed) {
  options.validate(joints);
  if (options_.deviation.size() == 0) options_.deviation = Eigen::VectorXd::Zero(joints);
  coloured_.resize(joints);
  for (double& value : coloured_) value = normal_(random_);  // as if it had run for ever
}

Eigen::VectorXd TorqueNoise::next() {
  const double kick = std::sqrt(1 - options_.pole * options_.pole);
  const double white = std::sqrt(1 - options_.coloured_part);
  Eigen::VectorXd noise(coloured_.size());
  for (Eigen::Index j = 0; j < noise.size(); ++j) {
    noise[j] = std::sqrt(options_.coloured_part) * coloured_[j] + white * normal_(random_);
    coloured_[j] = options_.pole * coloured_[j] + kick * normal_(random_);
  }
  return noise.cwiseProduct(options_.deviation);
}

}  // namespace dyngen::runtime
