// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/repeated_rounding.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "runtime/signals/low_pass_state.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kOrder = 4;                // of the joint state's filter
constexpr double kHighestOfRate = 0.49;  // of the sampling frequency: a cut-off

/// Standard deviation of a motion's accelerations around their mean over periods; NaN: none repeat.
VectorXd scatter(const Motion& run) {
  const auto period = static_cast<Index>(std::llround(run.period / run.sample_time));
  const Index rows = run.samples() - period;
  if (period == 0 || 2 * rows < period) return VectorXd::Constant(run.joints(), NAN);
  const MatrixXd difference = run.ddq.bottomRows(rows) - run.ddq.topRows(rows);
  return (difference.colwise().squaredNorm() / (2 * static_cast<double>(rows)))
      .cwiseSqrt()
      .transpose();
}

LowPass filter_of(const MotionSource& source) {
  const double highest = kHighestOfRate / source.sample_time;
  return design_butterworth(kOrder, std::min(source.cutoff.hz, highest), source.sample_time);
}

/// Standard deviation of the accelerations of white noise of unit variance.
double gain_of(const LowPass& filter) {
  constexpr Index kSamples = 2000;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  MatrixXd noise(kSamples, 1);
  for (double& value : noise.reshaped()) value = normal(random);
  return low_pass_states(filter, noise).ddq.norm() / std::sqrt(static_cast<double>(kSamples));
}

}  // namespace

bool repeats_rounding(const MotionSource& source, const EquationRules& rules) {
  const std::vector<double>& steps = source.condition.position_step;
  VectorXd rounding = VectorXd::Zero(source.joints());
  for (std::size_t j = 0; j < steps.size(); ++j) {
    rounding[static_cast<Index>(j)] = steps[j] / std::sqrt(12.0);
  }
  if (rounding.isZero(0)) return false;
  const VectorXd much_less = rules.repeated_rounding * gain_of(filter_of(source)) * rounding;
  bool repeats = false;
  source.pieces([&](const StreamPiece& piece) {
    repeats = repeats || (scatter(piece.motion).array() < much_less.array()).any();
  });
  return repeats;
}

}  // namespace dyngen::runtime
