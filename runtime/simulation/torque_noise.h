// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

namespace dyngen::runtime {

struct TorqueNoiseOptions {
  Eigen::VectorXd deviation{};  ///< (n) standard deviation, N m or N; empty: none
  double coloured_part = 0.5;   ///< of the variance that is AR(1), 0 .. 1; the rest is white
  double pole = 0.9;            ///< of the AR(1) part, per sample: 0 .. 1, not 1

  /// @throws std::invalid_argument
  void validate(int joints) const;
};

/// Noise of a torque measurement: white, and a part that is correlated in time,
/// x <- pole x + sqrt(1 - pole^2) * white. The same seed gives the same noise.
class TorqueNoise {
 public:
  /// @throws std::invalid_argument  of the options
  TorqueNoise(const TorqueNoiseOptions& options, int joints, std::uint64_t seed);

  /// Of the next sample, (n) N m or N.
  Eigen::VectorXd next();

 private:
  TorqueNoiseOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Eigen::VectorXd coloured_;
};

}  // namespace dyngen::runtime
