// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/raw_residual.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "runtime/effects/effect_signals.h"
#include "runtime/recordings/spline.h"
#include "runtime/signals/differences.h"

namespace dyngen::runtime {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Behind the parallel filter, at every sample; beyond its ends a signal is continued as constant.
VectorXd low_passed(const Decimator& decimator, const VectorXd& x) {
  const Index reach = decimator.taps.size() / 2;
  VectorXd longer(x.size() + 2 * reach);
  longer << VectorXd::Constant(reach, x[0]), x, VectorXd::Constant(reach, x[x.size() - 1]);
  VectorXd result(x.size());
  for (Index k = 0; k < x.size(); ++k) {
    result[k] = decimator.taps.dot(longer.segment(k, decimator.taps.size()));
  }
  return result;
}

/// The motion that the torque of a late joint belongs to. It is smooth where the torque jumps, so
/// that friction turns at its own moment between two samples.
Motion delayed(const Motion& motion, double delay) {
  const double first = motion.time[0], last = motion.time[motion.samples() - 1];
  const VectorXd at = (motion.time.array() - delay).max(first).min(last);
  Motion before = motion;
  for (MatrixXd Motion::*part : {&Motion::q, &Motion::dq, &Motion::ddq}) {
    before.*part = interpolate_spline(motion.time, motion.*part, at);
  }
  if (motion.temperature.size() > 0) {
    before.temperature = interpolate_linear(motion.time, motion.temperature, at);
  }
  return before;
}

/// Every sample an equation, of the motion some time before.
EffectRecordings at_full_rate(const EffectRecordings& data, double delay) {
  EffectRecordings raw = data;
  for (EffectRun& run : raw.runs) {
    run.decimator = design_decimator(1);
    if (delay == 0) continue;
    run.motion = delayed(run.motion, delay);
    run.time.array() -= delay;
  }
  return raw;
}

/// Torque of the model with effects, (N x n) of every run. A lag adds the rate of what the fit sees
/// of it: friction's jump at a reversal has none of its own.
RunResiduals torques(const EffectRecordings& data, const EffectPoint& point, double delay) {
  const EffectRecordings raw = at_full_rate(data, delay);
  const VectorXd lag = alignment_of(point.effects, data.joints()).lag;
  EffectSignals signals(raw);
  signals.set_beta(point.beta);
  signals.set_tangent_beta(point.beta);
  RunResiduals result;
  for (std::size_t run = 0; run < raw.runs.size(); ++run) {
    MatrixXd torque = signals.torque(run);
    for (const EffectInstance& effect : point.effects) {
      if (effect.law.kind == EffectKind::kAlignment) continue;
      const EffectSignature signature = signature_of(raw, signals, run, effect, {0});
      for (std::size_t i = 0; i < signature.joints.size(); ++i) {
        torque.col(signature.joints[i]) += signature.columns[i].col(0);
      }
    }
    for (Index j = 0; j < torque.cols(); ++j) {
      if (lag[j] == 0) continue;
      const VectorXd smooth = low_passed(data.runs[run].decimator, torque.col(j));
      torque.col(j) += lag[j] * first_difference(smooth, raw.runs[run].motion.sample_time);
    }
    result.push_back(std::move(torque));
  }
  return result;
}

}  // namespace

RunResiduals raw_residuals(const EffectRecordings& data, const EffectPoint& point) {
  const VectorXd delay = alignment_of(point.effects, data.joints()).delay;
  RunResiduals residuals;
  for (const EffectRun& run : data.runs) residuals.push_back(run.motion.tau);
  for (const double own : std::set<double>(delay.begin(), delay.end())) {
    const RunResiduals torque = torques(data, point, own);
    for (std::size_t run = 0; run < residuals.size(); ++run) {
      for (Index j = 0; j < delay.size(); ++j) {
        if (delay[j] == own) residuals[run].col(j) -= torque[run].col(j);
      }
    }
  }
  return residuals;
}

std::vector<bool> counted_samples(const EffectRun& run, int joint) {
  std::vector<bool> counted(static_cast<std::size_t>(run.motion.samples()), false);
  const Index first = first_sample(run.decimator), factor = run.decimator.factor;
  for (Index k = 0; k < run.rows.Y.rows(); ++k) {
    if (run.rows.counted(k, joint) == 0) continue;
    const Index begin = first + k * factor - factor / 2;
    for (Index i = begin; i < begin + factor; ++i) counted[static_cast<std::size_t>(i)] = true;
  }
  return counted;
}

VectorXd raw_rms(const EffectRecordings& data, const RunResiduals& residuals) {
  VectorXd squares = VectorXd::Zero(data.joints()), counts = squares;
  for (std::size_t run = 0; run < residuals.size(); ++run) {
    for (int j = 0; j < data.joints(); ++j) {
      const std::vector<bool> counted = counted_samples(data.runs[run], j);
      for (Index k = 0; k < residuals[run].rows(); ++k) {
        if (!counted[static_cast<std::size_t>(k)]) continue;
        squares[j] += residuals[run](k, j) * residuals[run](k, j);
        counts[j] += 1;
      }
    }
  }
  return squares.cwiseQuotient(counts.cwiseMax(1)).cwiseSqrt();
}

namespace {

/// Where the torque of a run's samples is asked for again: in a run, so many samples further.
struct Again {
  std::size_t run = 0;
  Index samples = 0;
};

/// @param repeats  equations of the run after which its motion repeats; 0: it does not
std::optional<Again> again_in(const EffectRecordings& data, std::size_t run, double repeats) {
  const EffectRun& here = data.runs[run];
  const auto factor = static_cast<double>(here.decimator.factor);
  const auto period = static_cast<Index>(std::llround(repeats * factor));
  if (period >= 1) return Again{run, period};
  if (!here.earlier) return std::nullopt;
  return Again{here.earlier->run,
               static_cast<Index>(std::llround(here.earlier->lag / here.motion.sample_time))};
}

}  // namespace

VectorXd raw_floor(const EffectRecordings& data, const RunResiduals& residuals,
                   const std::vector<double>& repeats) {
  VectorXd squares = VectorXd::Zero(data.joints()), counts = squares;
  for (std::size_t run = 0; run < residuals.size(); ++run) {
    const std::optional<Again> again = again_in(data, run, repeats[run]);
    if (!again) continue;
    const MatrixXd &now = residuals[run], &then = residuals[again->run];
    for (int j = 0; j < data.joints(); ++j) {
      const std::vector<bool> counted_now = counted_samples(data.runs[run], j);
      const std::vector<bool> counted_then = counted_samples(data.runs[again->run], j);
      for (Index k = std::max<Index>(0, -again->samples); k < now.rows(); ++k) {
        const Index other = k + again->samples;
        if (other >= then.rows()) break;
        if (!counted_now[static_cast<std::size_t>(k)] ||
            !counted_then[static_cast<std::size_t>(other)]) {
          continue;
        }
        squares[j] += 0.5 * std::pow(then(other, j) - now(k, j), 2);
        counts[j] += 1;
      }
    }
  }
  for (int j = 0; j < data.joints(); ++j) {
    if (counts[j] < 1 && !data.is_masked(j)) return raw_rms(data, residuals);
  }
  return squares.cwiseQuotient(counts.cwiseMax(1)).cwiseSqrt();
}

}  // namespace dyngen::runtime
