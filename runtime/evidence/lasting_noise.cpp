// SPDX-License-Identifier: MIT
#include "runtime/evidence/lasting_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// s(t) for w = 1.
double shape(double t, double period) {
  constexpr std::array<double, 3> kPeriods = {0.5, 2, 8};
  double sum = 0;
  for (const double times : kPeriods) sum += std::exp(-std::abs(t) / (times * period));
  return sum;
}

/// Half of s at the lags beside k periods: what a difference lacks.
double lacking(double period, int apart, Index lag) {
  const double distance = apart * period, l = static_cast<double>(lag);
  return 0.5 * (shape(distance - l, period) + shape(distance + l, period));
}

/// Of the same run, over one period.
const PeriodDifference* neighbours_of(const std::vector<PeriodDifference>& differences,
                                      std::size_t place) {
  while (differences[place].apart != 1) {
    if (place == 0) return nullptr;
    --place;
  }
  return &differences[place];
}

/// Variance of differences over one period.
double variance_of(const std::vector<PeriodDifference>& differences) {
  double sum = 0, pairs = 0;
  for (const PeriodDifference& each : differences) {
    if (each.apart != 1) continue;
    sum += each.pairs * each.covariance[0];
    pairs += each.pairs;
  }
  return sum / std::max(pairs, 1.0);
}

}  // namespace

double lasting_part(const std::vector<PeriodDifference>& differences) {
  double product = 0, square = 0;
  for (std::size_t i = 0; i < differences.size(); ++i) {
    const PeriodDifference& far = differences[i];
    const PeriodDifference* const near = neighbours_of(differences, i);
    if (far.apart == 1 || !near) continue;
    for (Index lag = 0; lag < far.covariance.size(); ++lag) {
      const double x = lacking(far.period, 1, lag) - lacking(far.period, far.apart, lag);
      product += far.pairs * x * (far.covariance[lag] - near->covariance[lag]);
      square += far.pairs * x * x;
    }
  }
  const double variance = variance_of(differences);
  return square > 0 && variance > 0 ? std::max(0.0, product / square / variance) : 0;
}

VectorXd lasting_covariance(const std::vector<PeriodDifference>& differences, double part) {
  VectorXd sum;
  double pairs = 0;
  for (const PeriodDifference& each : differences) {
    if (each.apart != 1) continue;
    if (sum.size() == 0) sum = VectorXd::Zero(each.covariance.size());
    for (Index lag = 0; lag < sum.size(); ++lag) {
      sum[lag] += each.pairs * lacking(each.period, 1, lag);
    }
    pairs += each.pairs;
  }
  return part * variance_of(differences) / std::max(pairs, 1.0) * sum;
}

}  // namespace dyngen::runtime
