// SPDX-License-Identifier: MIT
#include "runtime/signals/trim.h"

#include <cmath>

namespace dyngen::runtime {
namespace {

constexpr double kTrimForgotten = 0.01;

}  // namespace

double filter_trim(const LowPass& filter) {
  return static_cast<double>(settling_samples(filter, kTrimForgotten)) * filter.sample_time;
}

double kalman_trim(double sample_time, const KalmanOptions& options) {
  const double cutoff =
      std::pow(options.jerk_intensity / (options.measurement_variance * sample_time), 1.0 / 6);
  return -std::log(kTrimForgotten) /
         (0.5 * cutoff);  // the slowest pair decays with half the cut-off
}

Eigen::Index trim_samples(double seconds, double sample_time) {
  return static_cast<Eigen::Index>(std::ceil(seconds / sample_time - 1e-6));
}

}  // namespace dyngen::runtime
