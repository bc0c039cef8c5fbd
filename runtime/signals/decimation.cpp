// SPDX-License-Identifier: MIT
#include "runtime/signals/decimation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dyngen::runtime {
namespace {

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

double kaiser_shape(double attenuation_db) {
  if (attenuation_db > 50) return 0.1102 * (attenuation_db - 8.7);
  const double above = std::max(attenuation_db - 21, 0.0);
  return 0.5842 * std::pow(above, 0.4) + 0.07886 * above;
}

Eigen::Index half_length(const Decimator& decimator) { return decimator.taps.size() / 2; }

}  // namespace

Decimator design_decimator(Eigen::Index factor, double pass, double attenuation_db) {
  if (factor < 1) {
    throw std::invalid_argument(fmt::format("design_decimator(): factor {} is below 1", factor));
  }
  if (!(pass >= 0.5 && pass <= 0.95)) {
    throw std::invalid_argument(fmt::format("design_decimator(): pass {} is not 0.5..0.95", pass));
  }
  if (!(attenuation_db >= 30 && attenuation_db <= 120)) {
    throw std::invalid_argument(
        fmt::format("design_decimator(): attenuation_db {} is not 30..120", attenuation_db));
  }
  if (factor == 1) return {Eigen::VectorXd::Ones(1), 1, pass, attenuation_db};
  // Kaiser's rule (1974) for the length; frequencies in cycles a sample.
  const double nyquist = 0.5 / static_cast<double>(factor);
  const double transition = 2 * (1 - pass) * nyquist;
  const double length = (attenuation_db - 7.95) / (14.36 * transition);
  const auto half = static_cast<Eigen::Index>(std::ceil(length / 2));
  const double shape = kaiser_shape(attenuation_db);
  Decimator decimator{Eigen::VectorXd(2 * half + 1), factor, pass, attenuation_db};
  for (Eigen::Index i = 0; i <= half; ++i) {
    const double x = 2 * std::numbers::pi * nyquist * static_cast<double>(i);
    const double edge = static_cast<double>(i) / static_cast<double>(half);
    const double tap = (i == 0 ? 1 : std::sin(x) / x) *
                       bessel_i0(shape * std::sqrt(std::max(0.0, 1 - edge * edge)));
    decimator.taps[half + i] = tap;
    decimator.taps[half - i] = tap;
  }
  decimator.taps /= decimator.taps.sum();
  return decimator;
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
