// SPDX-License-Identifier: MIT
#include "runtime/signals/decimation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

constexpr double kStop = 60;  // dB, of a windowed sinc; Kaiser's rules are for 50 and more

/// Modified Bessel function of the first kind, order 0, by its series.
double bessel_i0(double x) {
  double term = 1, sum = 1;
  for (int k = 1; term > 1e-17 * sum; ++k) {
    const double half = x / (2 * k);
    term *= half * half;
    sum += term;
  }
  return sum;
}

Eigen::Index half_length(const Decimator& decimator) { return decimator.taps.size() / 2; }

void check(Eigen::Index factor, const FilterShape& shape) {
  constexpr int kMostAverages = 8;
  if (factor < 1) {
    throw std::invalid_argument(fmt::format("design_decimator(): factor {} is below 1", factor));
  }
  if (!(shape.pass >= 0.5 && shape.pass <= 0.95)) {
    throw std::invalid_argument(
        fmt::format("design_decimator(): pass {} is not 0.5..0.95", shape.pass));
  }
  // an odd number of them has an even number of taps where the factor is even
  if (shape.averages < 0 || shape.averages > kMostAverages || shape.averages % 2 != 0) {
    throw std::invalid_argument(
        fmt::format("design_decimator(): {} averages, expected 0 or an even number up to {}",
                    shape.averages, kMostAverages));
  }
}

VectorXd windowed_sinc(Eigen::Index factor, double pass) {
  // Kaiser's rule (1974) for the length; frequencies in cycles a sample.
  const double nyquist = 0.5 / static_cast<double>(factor);
  const double transition = 2 * (1 - pass) * nyquist;
  const double length = (kStop - 7.95) / (14.36 * transition);
  const auto half = static_cast<Eigen::Index>(std::ceil(length / 2));
  constexpr double kWindow = 0.1102 * (kStop - 8.7);
  VectorXd taps(2 * half + 1);
  for (Eigen::Index i = 0; i <= half; ++i) {
    const double x = 2 * std::numbers::pi * nyquist * static_cast<double>(i);
    const double edge = static_cast<double>(i) / static_cast<double>(half);
    const double tap = (i == 0 ? 1 : std::sin(x) / x) *
                       bessel_i0(kWindow * std::sqrt(std::max(0.0, 1 - edge * edge)));
    taps[half + i] = tap;
    taps[half - i] = tap;
  }
  return taps / taps.sum();
}

VectorXd moving_averages(Eigen::Index factor, int count) {
  VectorXd taps = VectorXd::Ones(1);
  for (int i = 0; i < count; ++i) {
    VectorXd next = VectorXd::Zero(taps.size() + factor - 1);
    for (Eigen::Index k = 0; k < factor; ++k) next.segment(k, taps.size()) += taps;
    taps = next / static_cast<double>(factor);
  }
  return taps;
}

}  // namespace

Decimator design_decimator(Eigen::Index factor, const FilterShape& shape) {
  check(factor, shape);
  if (factor == 1) return {VectorXd::Ones(1), 1, shape};
  return {shape.averages > 0 ? moving_averages(factor, shape.averages)
                             : windowed_sinc(factor, shape.pass),
          factor, shape};
}

Eigen::Index first_sample(const Decimator& decimator) {
  return (half_length(decimator) + decimator.factor - 1) / decimator.factor * decimator.factor;
}

Eigen::Index decimated_samples(const Decimator& decimator, Eigen::Index samples) {
  const Eigen::Index last = samples - 1 - half_length(decimator);
  const Eigen::Index first = first_sample(decimator);
  return last < first ? 0 : (last - first) / decimator.factor + 1;
}

Eigen::MatrixXd decimate(const Decimator& decimator,
                         const Eigen::Ref<const Eigen::MatrixXd>& columns) {
  const Eigen::Index taps = decimator.taps.size();
  const Eigen::Index begin = first_sample(decimator) - half_length(decimator);
  Eigen::MatrixXd result(decimated_samples(decimator, columns.rows()), columns.cols());
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const auto x = columns.col(j);
    for (Eigen::Index k = 0; k < result.rows(); ++k) {
      result(k, j) = decimator.taps.dot(x.segment(begin + k * decimator.factor, taps));
    }
  }
  return result;
}

}  // namespace dyngen::runtime
