// SPDX-License-Identifier: MIT
#include "runtime/evidence/slow_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

#include "runtime/estimation/whitener.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kShortestMemory = 8;  // samples
constexpr double kApart = 4;           // from one memory to the next
constexpr double kNegligible = 1e-3;   // of a joint's deviation: such a part is left out
constexpr std::array<double, 5> kRatios = {0.25, 0.5, 1, 2, 4};  // 1: 1/f noise
/// Of the variance. Noise of accelerations may be thousands of times what is slow beside it.
constexpr std::array<double, 19> kShares = {1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 2.5e-3, 5e-3,
                                            0.01, 0.02, 0.04, 0.08, 0.13, 0.2,    0.3,
                                            0.4,  0.5,  0.6,  0.75, 0.9};
constexpr double kBriefMemory = 2;  // samples: between none and the shortest
constexpr double kLittle = 0.03;    // of a deviation
constexpr int kPoleSteps = 200;     // of variances, one by one
constexpr Index kGrain = 32;        // samples: lengths are multiples, for the transform's sake

/// Slow parts whose variances grow by a ratio from one memory to the next; they sum to 1.
std::vector<SlowNoise> slow_parts(double longest, double ratio) {
  std::vector<SlowNoise> parts;
  double variance = 1, sum = 0;
  for (double memory = kShortestMemory; memory <= longest; memory *= kApart) {
    parts.push_back({std::exp(-1 / memory), std::sqrt(variance)});
    sum += variance;
    variance *= ratio;
  }
  for (SlowNoise& part : parts) part.deviation /= std::sqrt(sum);
  return parts;
}

std::vector<SlowNoise> scaled(std::vector<SlowNoise> parts, double variance) {
  for (SlowNoise& part : parts) part.deviation *= std::sqrt(variance);
  return parts;
}

/// What slow parts give to the covariance of differences at lags from 0.
VectorXd differences_of(const std::vector<SlowNoise>& parts, Index lags, double period) {
  VectorXd covariance = VectorXd::Zero(lags);
  for (const SlowNoise& part : parts) {
    for (Index lag = 0; lag < lags; ++lag) {
      const auto l = static_cast<double>(lag);
      covariance[lag] += part.deviation * part.deviation *
                         (std::pow(part.pole, l) - 0.5 * std::pow(part.pole, std::abs(period - l)) -
                          0.5 * std::pow(part.pole, period + l));
    }
  }
  return covariance;
}

/// Twice the logarithm of Whittle's likelihood, but for a constant.
double likelihood(const std::vector<DifferenceLine>& lines, const JointNoise& noise) {
  double sum = 0;
  for (const DifferenceLine& line : lines) {
    const double expected = line.passed * noise.density(line.frequency);
    sum -= std::log(expected) + line.power / expected;
  }
  return 2 * sum;
}

}  // namespace

std::vector<DifferenceLine> difference_lines(const VectorXd& difference, const VectorXd& counted,
                                             double period, const AutoregressiveNoise& process,
                                             const NoiseRules& rules) {
  std::vector<DifferenceLine> lines;
  const Index samples = difference.size() - difference.size() % kGrain;
  const double weight = counted.head(samples).sum();
  if (!(weight > 0)) return lines;
  MatrixXd white = difference;
  Whitener({process, {}}, counted).apply(white);
  // lines halfway between those of the transform: of two periods those would be harmonics, all
  std::vector<std::complex<double>> turned(static_cast<std::size_t>(samples)), spectrum;
  for (Index t = 0; t < samples; ++t) {
    turned[static_cast<std::size_t>(t)] =
        white(t, 0) *
        std::polar(1.0, -M_PI * static_cast<double>(t) / static_cast<double>(samples));
  }
  Eigen::FFT<double> transform;
  transform.fwd(spectrum, turned);
  for (Index k = 0; k < samples / 2; ++k) {
    const double frequency = (static_cast<double>(k) + 0.5) / static_cast<double>(samples);
    // of two recordings nothing is in common
    const double passed = std::isfinite(period) ? 1 - std::cos(2 * M_PI * frequency * period) : 1;
    if (passed < rules.line_transmission) continue;
    const double left = std::norm(spectrum[static_cast<std::size_t>(k)]) / weight;
    lines.push_back({frequency, passed, left * density(process, frequency)});
  }
  return lines;
}

namespace {

/// A process alone, and the best with slow parts beside it.
struct Choice {
  JointNoise alone, with_slow;
  double gain = 0;  ///< of twice the log likelihood, less the price of parameters
};

/// Slow parts that make a part of the variance of the differences, and the process beside them.
JointNoise beside_process(const JointDifferences& joint, const DifferenceLengths& lengths,
                          const std::vector<SlowNoise>& parts, double share) {
  const Index lags = joint.covariance.size();
  const double unit = differences_of(parts, 1, lengths.period)[0];
  JointNoise noise{{}, scaled(parts, share * joint.covariance[0] / unit)};
  noise.quick = fit_autoregression(
      joint.covariance - differences_of(noise.slow, lags, lengths.period), joint.samples);
  return noise;
}

/// Slow parts whose variances are each those of the greatest likelihood (multiplicative updates:
/// Fevotte, Bertin and Durrieu 2009, with the exponent 1/2 that never lowers the likelihood).
JointNoise refined(const JointDifferences& joint, JointNoise noise) {
  const auto lines = static_cast<Index>(joint.lines.size());
  const auto parts = static_cast<Index>(noise.slow.size());
  MatrixXd densities(lines, parts);       // of each part
  VectorXd process(lines), power(lines);  // of the process, and what all are to give
  for (Index i = 0; i < lines; ++i) {
    const DifferenceLine& line = joint.lines[static_cast<std::size_t>(i)];
    power[i] = line.power / line.passed;
    process[i] = density(noise.quick, line.frequency);
    for (Index k = 0; k < parts; ++k) {
      densities(i, k) = density(noise.slow[static_cast<std::size_t>(k)], line.frequency);
    }
  }
  VectorXd factors = VectorXd::Ones(parts);  // of the variances
  for (int step = 0; step < kPoleSteps; ++step) {
    const VectorXd expected = process + densities * factors;
    const VectorXd up = densities.transpose() * power.cwiseQuotient(expected.cwiseAbs2());
    const VectorXd down = densities.transpose() * expected.cwiseInverse();
    factors.array() *= (up.array() / down.array()).sqrt();
  }
  for (Index k = 0; k < parts; ++k) {
    noise.slow[static_cast<std::size_t>(k)].deviation *= std::sqrt(factors[k]);
  }
  const double least = kNegligible * noise.deviation();
  std::erase_if(noise.slow, [&](const SlowNoise& part) { return part.deviation <= least; });
  return noise;
}

/// The process alone with a little beside it of every memory, from none: of noise of accelerations
/// it has the quick part right, and hardly anything of what is a thousandth of it at low lines.
JointNoise beside_alone(const JointNoise& alone, const DifferenceLengths& lengths) {
  JointNoise noise = alone;
  const double little = kLittle * alone.deviation();
  noise.slow = {{0, little}, {std::exp(-1 / kBriefMemory), little}};
  for (const SlowNoise& part : slow_parts(lengths.longest, 1)) {
    noise.slow.push_back({part.pole, little});
  }
  return noise;
}

Choice choice_of(const JointDifferences& joint, const DifferenceLengths& lengths,
                 double slow_part_price) {
  Choice choice{{joint.process, {}}, {}, 0};
  choice.with_slow = choice.alone;
  if (lengths.longest < kShortestMemory || joint.lines.empty() ||
      !(choice.alone.quick.innovation > 0)) {
    return choice;
  }
  const double price = std::log(joint.samples);  // of a parameter (Schwarz 1978)
  const auto worth = [&](const JointNoise& noise) {
    return likelihood(joint.lines, noise) -
           price * static_cast<double>(noise.quick.coefficients.size());
  };
  choice.gain = -slow_part_price;  // of slow parts that are nothing
  const double alone = worth(choice.alone) + slow_part_price;
  for (const double ratio : kRatios) {
    const std::vector<SlowNoise> parts = slow_parts(lengths.longest, ratio);
    for (const double share : kShares) {
      JointNoise noise = beside_process(joint, lengths, parts, share);
      if (!(noise.quick.innovation > 0)) break;
      const double gain = worth(noise) - alone;
      if (gain <= choice.gain) continue;
      choice.gain = gain;
      choice.with_slow = std::move(noise);
    }
  }
  std::vector<JointNoise> starts = {beside_alone(choice.alone, lengths)};
  if (!choice.with_slow.slow.empty()) starts.push_back(choice.with_slow);
  for (JointNoise& start : starts) {
    JointNoise each = refined(joint, std::move(start));
    const double gain =
        worth(each) - alone - slow_part_price * static_cast<double>(each.slow.size());
    if (gain <= choice.gain) continue;
    choice.gain = gain;
    choice.with_slow = std::move(each);
  }
  return choice;
}

}  // namespace

std::vector<JointNoise> noise_of_differences(const std::vector<JointDifferences>& joints,
                                             const DifferenceLengths& lengths,
                                             const NoiseRules& rules) {
  std::vector<Choice> choices;
  double gain = 0;
  for (const JointDifferences& joint : joints) {
    choices.push_back(choice_of(joint, lengths, rules.slow_part_price));
    gain += choices.back().gain;
  }
  std::vector<JointNoise> all;
  for (const Choice& choice : choices) all.push_back(gain > 0 ? choice.with_slow : choice.alone);
  for (JointNoise& joint : all) {
    const double least = kNegligible * joint.deviation();
    std::erase_if(joint.slow, [&](const SlowNoise& part) { return part.deviation <= least; });
  }
  return all;
}

}  // namespace dyngen::runtime
