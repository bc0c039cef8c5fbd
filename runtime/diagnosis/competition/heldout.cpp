// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/heldout.h"

#include <cmath>

#include "runtime/effects/effect_residual.h"
#include "runtime/estimation/whitener.h"

namespace dyngen::runtime {
namespace {

constexpr double kGain = 2;          // by which squares must fall
constexpr double kDeviations = 2.3;  // from what an effect would have done: 1 % of those there are
constexpr double kInformative = 4;   // squares of the change: with less they say nothing for it
constexpr double kJolt = 4;          // standard deviations that noise hardly has
constexpr double kRefit = 10;        // by which squares may rise as the model's estimate changes

}  // namespace

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RunResiduals residuals_of(const EffectRecordings& data, const EffectPoint& point) {
  RunResiduals residuals;
  for (const RowBlock& block : without_effects(data, point)) {
    residuals.push_back(residual(block, point.beta).cwiseProduct(block.counted));
  }
  return residuals;
}

namespace {

/// Residuals in units of the noise, which is white there.
RunResiduals whitened(const EffectRecordings& data, RunResiduals residuals,
                      const TorqueNoiseModel& noise) {
  for (std::size_t run = 0; run < residuals.size(); ++run) {
    for (Index j = 0; j < data.joints(); ++j) {
      MatrixXd rest = residuals[run].col(j);
      Whitener(noise.joints[static_cast<std::size_t>(j)], data.runs[run].rows.counted.col(j))
          .apply(rest);
      residuals[run].col(j) = rest;
    }
  }
  return residuals;
}

}  // namespace

VectorXd whitened_squares(const EffectRecordings& data, const RunResiduals& residuals,
                          const TorqueNoiseModel& noise) {
  VectorXd squares = VectorXd::Zero(data.joints());
  for (const MatrixXd& run : whitened(data, residuals, noise)) {
    squares += run.colwise().squaredNorm().transpose();
  }
  return squares;
}

VectorXd heldout_squares(const EffectRecordings& heldout, EffectPoint point,
                         const TorqueNoiseModel& noise) {
  point.initial.clear();
  return whitened_squares(heldout, residuals_of(heldout, point), noise);
}

bool HeldoutProof::helps() const { return before - after >= kGain; }

bool HeldoutProof::informs() const { return change >= kInformative; }

bool HeldoutProof::agrees() const {
  const double ratio = fitted > 0 ? change / fitted : 0;
  const double expected = change - 2 * parameters * ratio;
  return informs() &&
         before - after >= expected - kDeviations * 2 * std::sqrt(change * (1 + ratio));
}

bool HeldoutProof::harms() const { return after - before >= kRefit; }

HeldoutProof heldout_proof(const EffectRecordings& heldout, EffectPoint before, EffectPoint after,
                           const TorqueNoiseModel& noise) {
  before.initial.clear();
  after.initial.clear();
  const RunResiduals first = whitened(heldout, residuals_of(heldout, before), noise);
  const RunResiduals second = whitened(heldout, residuals_of(heldout, after), noise);
  HeldoutProof proof;
  for (std::size_t run = 0; run < first.size(); ++run) {
    const auto one = first[run].array(), other = second[run].array();
    const Eigen::ArrayXXd noise_like = (one.abs().min(other.abs()) < kJolt).template cast<double>();
    proof.before += (noise_like * one.square()).sum();
    proof.after += (noise_like * other.square()).sum();
    proof.change += (noise_like * (one - other).square()).sum();
  }
  return proof;
}

}  // namespace dyngen::runtime
