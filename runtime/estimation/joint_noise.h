// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/noise_model.h"

namespace dyngen::runtime {

/// A slow part of a joint's noise: s_t = pole s_(t-1) + white noise.
struct SlowNoise {
  double pole = 0;       ///< in [0, 1); exp(-1/T), T the memory in samples; 0: white
  double deviation = 0;  ///< standard deviation of s, N m or N
};

/// Noise of one joint: an autoregressive process and slow parts beside it, independent of one
/// another. A sum of first order parts whose memories are a factor apart is 1/f noise between the
/// shortest and the longest of them.
struct JointNoise {
  AutoregressiveNoise quick;
  std::vector<SlowNoise> slow;

  [[nodiscard]] double deviation() const;
  /// Spectral density, (N m)^2 for a sample; its mean over all frequencies is the variance.
  /// @param frequency  cycles for a sample, 0 .. 0.5
  [[nodiscard]] double density(double frequency) const;
  /// All of them as processes of the same kind.
  [[nodiscard]] std::vector<AutoregressiveNoise> parts() const;
};

/// Spectral density of the autoregressive part alone, and of a slow one.
double density(const AutoregressiveNoise& noise, double frequency);
double density(const SlowNoise& noise, double frequency);

/// Autocovariance of a stationary autoregressive process at lags 0 .. `most`.
Eigen::VectorXd autocovariance(const AutoregressiveNoise& noise, Eigen::Index most);

/// Each joint with an autoregressive process and nothing beside it.
std::vector<JointNoise> quick_noise(const std::vector<AutoregressiveNoise>& joints);

}  // namespace dyngen::runtime
