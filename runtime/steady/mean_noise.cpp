// SPDX-License-Identifier: MIT
#include "runtime/steady/mean_noise.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "runtime/estimation/robust_regression.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Expected power of the j-th cosine over T s, of a part with variance 1 that is forgotten with
/// the time `memory`: the double integral of its covariance exp(-|t - s| / memory).
double expected_power(double memory, double T, Index j) {
  const double rate = 1 / memory, w = std::numbers::pi * static_cast<double>(j) / T;
  const double square = rate * rate + w * w;
  const double end = (j % 2 == 0 ? 1.0 : -1.0) * std::exp(-rate * T);
  return 2 * rate / square - 4 * rate * rate * (1 - end) / (T * square * square);
}

/// Variance of the mean over T s of the same part.
double variance_of_mean(double memory, double T) {
  const double x = T / memory;
  constexpr double kSmall = 1e-4;  // below, the difference of nearly equal numbers: its series
  if (x < kSmall) return 1 - x / 3;
  return 2 / x + 2 * std::expm1(-x) / (x * x);
}

/// Mean over T s of exp(-t / memory).
double decay_over(double memory, double T) { return -std::expm1(-T / memory) * memory / T; }

/// Times from what the band shows to what the runs show.
VectorXd memories(double longest, const SteadyRules& rules) {
  constexpr double kFactor = 2.5;  // sums of parts so far apart follow 1/f within 5 %
  const double first = 1 / (2 * std::numbers::pi * rules.band), last = rules.slowest * longest;
  const auto count =
      static_cast<Index>(1 + std::max(0.0, std::floor(std::log(last / first) / std::log(kFactor))));
  return VectorXd::NullaryExpr(
      count, [&](Index k) { return first * std::pow(kFactor, static_cast<double>(k)); });
}

}  // namespace

CosinePowers cosine_powers(const Stretch& stretch, const VectorXd& residual,
                           const SteadyRules& rules) {
  const double T = stretch.seconds();
  constexpr Index kMost = 64;
  const auto band = static_cast<Index>(std::floor(2 * T * rules.band));
  const Index count = std::clamp<Index>(band, 2, std::min(kMost, residual.size() / 2));
  const VectorXd sums = cosine_sums(residual, static_cast<int>(count)).row(0).transpose();
  return {stretch, 2 * stretch.sample_time * stretch.sample_time / T * sums.cwiseAbs2()};
}

double MeanNoise::of_means(const Stretch& a, const Stretch& b) const {
  if (a.recording != b.recording) return 0;
  const bool same = a.first == b.first;
  double sum = same ? density / a.seconds() : 0;
  const Stretch &early = a.begin <= b.begin ? a : b, &late = a.begin <= b.begin ? b : a;
  const double gap = std::max(0.0, late.begin - early.begin - early.seconds());
  for (Index k = 0; k < memory.size(); ++k) {
    if (same) {
      sum += variance[k] * variance_of_mean(memory[k], a.seconds());
    } else {
      sum += variance[k] * std::exp(-gap / memory[k]) * decay_over(memory[k], a.seconds()) *
             decay_over(memory[k], b.seconds());
    }
  }
  return sum;
}

MeanNoise fit_mean_noise(const std::vector<CosinePowers>& stretches, const SteadyRules& rules) {
  if (stretches.empty()) throw std::invalid_argument("fit_mean_noise(): expected a stretch");
  Index rows = 0;
  double longest = 0;
  for (const CosinePowers& own : stretches) {
    rows += own.powers.size();
    longest = std::max(longest, own.stretch.seconds());
  }
  const VectorXd memory = memories(longest, rules);
  const Index parts = memory.size();
  MatrixXd E(rows, parts + 1);
  VectorXd powers(rows);
  Index row = 0;
  for (const CosinePowers& own : stretches) {
    for (Index j = 0; j < own.powers.size(); ++j, ++row) {
      powers[row] = own.powers[j];
      for (Index k = 0; k < parts; ++k) {
        E(row, k) = expected_power(memory[k], own.stretch.seconds(), j + 1);
      }
    }
  }
  E.col(parts).setOnes();
  // parts of equal power to begin with; a floor keeps a signal without noise from dividing by 0
  const double mean = powers.mean();
  constexpr double kFloor = 1e-12;
  const double floor = std::max(kFloor * mean, 1e-300);
  VectorXd weight =
      mean / static_cast<double>(parts + 1) * E.colwise().mean().transpose().cwiseInverse();
  constexpr int kSteps = 1000;
  for (int step = 0; step < kSteps; ++step) {
    const VectorXd model = (E * weight).array() + floor;
    const VectorXd gain = E.transpose() * (powers.array() / model.array().square()).matrix();
    const VectorXd loss = E.transpose() * model.cwiseInverse();
    weight.array() *= gain.array() / loss.array();
  }
  MeanNoise noise;
  noise.memory = memory;
  noise.variance = weight.head(parts);
  noise.density = weight[parts];
  constexpr int kOfEach = 2;  // the lowest cosines of a stretch, which stand nearest to its mean
  noise.degrees = kOfEach * static_cast<int>(stretches.size());
  return noise;
}

MatrixXd covariance_of_means(const MeanNoise& noise, const std::vector<Stretch>& stretches) {
  const auto count = static_cast<Index>(stretches.size());
  MatrixXd covariance(count, count);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j <= i; ++j) {
      covariance(i, j) = covariance(j, i) = noise.of_means(stretches[static_cast<std::size_t>(i)],
                                                           stretches[static_cast<std::size_t>(j)]);
    }
  }
  return covariance;
}

}  // namespace dyngen::runtime
