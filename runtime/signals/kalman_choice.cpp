// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <limits>
#include <stdexcept>

#include "runtime/signals/kalman_filter.h"
#include "runtime/signals/kalman_steps.h"

namespace dyngen::runtime {
namespace {

// log10 of jerk_intensity T^5 / measurement_variance: from a filter that remembers thousands of
// samples to one that believes every sample.
constexpr double kSmallest = -21;
constexpr double kLargest = 6;

/// What the likelihood needs of the innovations.
struct Innovations {
  double log_variances = 0;  ///< sum of ln(variance / measurement variance)
  double squares = 0;        ///< sum of nu^2 / (variance / measurement variance)
};

Innovations innovations(const Eigen::VectorXd& y, double ratio) {
  const auto updates = kalman_updates(ratio, y.size());
  Eigen::Vector3d x = kalman_start(ratio).from_samples * (y.head<3>().array() - y[0]).matrix();
  Innovations sums;
  double log_variance = 0;
  const auto steps = static_cast<Eigen::Index>(updates.size());
  for (Eigen::Index k = 3; k < y.size(); ++k) {
    const KalmanUpdate& step = update_at(updates, k);
    x = kalman_advance(x);
    const double variance = step.predicted(0, 0) + 1;
    if (k - 3 < steps) log_variance = std::log(variance);
    const double innovation = y[k] - y[0] - x[0];
    sums.log_variances += log_variance;
    sums.squares += innovation * innovation / variance;
    x += innovation * step.gain;
  }
  return sums;
}

/// The exponent with the least cost: whole ones first, then a golden section around the best.
double least_cost(const std::function<double(double)>& cost) {
  double best = kSmallest, least = std::numeric_limits<double>::infinity();
  for (double exponent = kSmallest; exponent <= kLargest; exponent += 1) {
    const double value = cost(exponent);
    if (value < least) {
      least = value;
      best = exponent;
    }
  }
  constexpr double kGolden = 0.6180339887498949;
  double low = best - 1, high = best + 1;
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double left_cost = cost(left), right_cost = cost(right);
  while (high - low > 0.02) {
    if (left_cost < right_cost) {
      high = right;
      right = left;
      right_cost = left_cost;
      left = high - kGolden * (high - low);
      left_cost = cost(left);
    } else {
      low = left;
      left = right;
      left_cost = right_cost;
      right = low + kGolden * (high - low);
      right_cost = cost(right);
    }
  }
  return 0.5 * (low + high);
}

void check_enough(const char* function, const Eigen::VectorXd& y, double sample_time) {
  if (y.size() < 8 || !y.allFinite() || !(sample_time > 0)) {
    throw std::invalid_argument(
        fmt::format("{}(): {} samples of {} s, needed: at least eight, finite, of positive length",
                    function, y.size(), sample_time));
  }
}

}  // namespace

KalmanOptions choose_kalman_options(const Eigen::VectorXd& y, double sample_time) {
  check_enough("choose_kalman_options", y, sample_time);
  if (y.minCoeff() == y.maxCoeff()) return {};
  const auto count = static_cast<double>(y.size() - 3);
  const double exponent = least_cost([&](double e) {
    const Innovations sums = innovations(y, std::pow(10, e));
    return count * std::log(sums.squares + std::numeric_limits<double>::min()) + sums.log_variances;
  });
  const double ratio = std::pow(10, exponent);
  const double variance = innovations(y, ratio).squares / count;
  return {ratio * variance / std::pow(sample_time, 5), variance};
}

double choose_jerk_intensity(const Eigen::VectorXd& y, double sample_time,
                             double measurement_variance) {
  check_enough("choose_jerk_intensity", y, sample_time);
  KalmanOptions{1, measurement_variance}.validate();
  if (y.minCoeff() == y.maxCoeff()) return 0;
  const double exponent = least_cost([&](double e) {
    const Innovations sums = innovations(y, std::pow(10, e));
    return sums.log_variances + sums.squares / measurement_variance;
  });
  return std::pow(10, exponent) * measurement_variance / std::pow(sample_time, 5);
}

double choose_jerk_intensity(const Eigen::VectorXd& y, double sample_time) {
  return choose_kalman_options(y, sample_time).jerk_intensity;
}

}  // namespace dyngen::runtime
