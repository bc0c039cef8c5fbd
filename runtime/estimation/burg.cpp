// SPDX-License-Identifier: MIT
#include "runtime/estimation/burg.h"

#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLeastErrors = 10;  // for each coefficient

/// Errors of prediction within one stretch: of each sample from those before it, and from those
/// behind it.
struct Errors {
  VectorXd forward, backward;

  /// Of one order more; the forward errors begin a sample later, the backward ones end one earlier.
  [[nodiscard]] Errors next(double reflection) const {
    const Index rows = forward.size() - 1;
    return {forward.tail(rows) - reflection * backward.head(rows),
            backward.head(rows) - reflection * forward.tail(rows)};
  }
};

double correlation_time(const AutoregressiveNoise& noise) {
  const double gain = 1 - noise.coefficients.sum();
  return std::pow(noise.innovation / (gain * noise.deviation), 2);
}

}  // namespace

AutoregressiveNoise autoregression_of(const std::vector<VectorXd>& stretches, Index most_order) {
  std::vector<Errors> errors;
  double samples = 0, squares = 0;
  for (const VectorXd& stretch : stretches) {
    samples += static_cast<double>(stretch.size());
    squares += stretch.squaredNorm();
    if (stretch.size() > 0) errors.push_back({stretch, stretch});
  }
  AutoregressiveNoise best;
  if (!(squares > 0)) return best;
  best.deviation = best.innovation = std::sqrt(squares / samples);
  VectorXd a(0);
  double error = squares / samples;
  double least = samples * std::log(error);
  for (Index p = 1; p <= most_order; ++p) {
    double product = 0, sum = 0, count = 0;
    for (const Errors& own : errors) {
      const Index rows = own.forward.size() - 1;
      product += own.forward.tail(rows).dot(own.backward.head(rows));
      sum += own.forward.tail(rows).squaredNorm() + own.backward.head(rows).squaredNorm();
      count += static_cast<double>(rows);
    }
    if (count < kLeastErrors * static_cast<double>(p) || !(sum > 0)) break;
    const double reflection = 2 * product / sum;
    if (!(std::abs(reflection) < 1)) break;
    VectorXd longer(p);
    for (Index k = 0; k < a.size(); ++k) longer[k] = a[k] - reflection * a[a.size() - 1 - k];
    longer[p - 1] = reflection;
    a = std::move(longer);
    error *= 1 - reflection * reflection;
    std::vector<Errors> next;
    for (const Errors& own : errors) {
      if (own.forward.size() > 1) next.push_back(own.next(reflection));
    }
    errors = std::move(next);
    const double criterion = samples * std::log(error) + std::log(samples) * static_cast<double>(p);
    if (criterion < least) {
      least = criterion;
      best.coefficients = a;
      best.innovation = std::sqrt(error);
    }
  }
  best.correlation_time = correlation_time(best);
  return best;
}

std::vector<VectorXd> stretches_of(const VectorXd& series, const VectorXd& counted) {
  std::vector<VectorXd> stretches;
  for (Index start = 0; start < series.size();) {
    Index end = start;
    while (end < series.size() && counted[end] != 0) ++end;
    if (end > start) stretches.emplace_back(series.segment(start, end - start));
    start = end + 1;
  }
  return stretches;
}

}  // namespace dyngen::runtime
