// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/ripple/joint_ripple.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "runtime/diagnosis/equation_sets/raw_residual.h"
#include "runtime/tools/dynid/effects/effect_laws.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr int kStatedMultiples = 24;  // of the gear ratio: poles and slots of usual motors
/// Orders of an effect and of the spectrum that are so close are one: the intervals of a scan over
/// a grid do not say more.
constexpr double kSameOrder = 0.005;

bool is_ripple(const EffectInstance& effect) {
  return effect.joint >= 0 &&
         (effect.law.family == "torque_ripple" || effect.law.family == "kinematic_ripple");
}

std::optional<double> parameter_of(const EffectInstance& effect, const std::string& name) {
  for (std::size_t p = 0; p < effect.law.parameters.size(); ++p) {
    if (effect.law.parameters[p].name != name) continue;
    const double value = effect.parameters[static_cast<Index>(p)];
    if (std::isfinite(value)) return value;
  }
  return std::nullopt;
}

/// What one joint shows in all runs of one sample time.
RippleData joint_data(const std::vector<RippleRun>& runs, int joint) {
  RippleData data;
  data.sample_time = runs.front().sample_time;
  data.run_starts.clear();
  Index samples = 0;
  for (const RippleRun& run : runs) {
    data.run_starts.push_back(samples);
    samples += run.q.rows();
  }
  for (VectorXd* part : {&data.q, &data.dq, &data.ddq, &data.residual}) part->resize(samples);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Index at = data.run_starts[i], count = runs[i].q.rows();
    data.q.segment(at, count) = runs[i].q.col(joint);
    data.dq.segment(at, count) = runs[i].dq.col(joint);
    data.ddq.segment(at, count) = runs[i].ddq.col(joint);
    data.residual.segment(at, count) = runs[i].residual.col(joint);
  }
  return data;
}

/// Whether an order of an effect is that of a line: within its interval, or as close as a scan.
bool same_order(const RippleLine& line, double order) {
  return std::abs(line.order.value - order) <=
         std::max(kSameOrder * order, line.order.high - line.order.value);
}

/// Whether one wave stands for both directions: a row has no other.
bool is_shared(const RippleLine& line) {
  constexpr double kHalf = 0.7;  // its square: half of the power
  return line.both.amplitude.low > 0 &&
         line.both.amplitude.value >=
             kHalf * std::max(line.forward.amplitude.value, line.backward.amplitude.value);
}

void compare(JointRipple& own, const EffectRipple& effect) {
  const std::string words = std::isfinite(effect.amplitude)
                                ? fmt::format("{} of order {:.4g} with {:.3g} N m", effect.name,
                                              effect.order, effect.amplitude)
                                : fmt::format("{} of order {:.4g}", effect.name, effect.order);
  const auto& lines = own.result.lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!same_order(lines[i], effect.order)) continue;
    own.found_as[i] = effect.name;
    const RippleNumber& amplitude = lines[i].both.amplitude;
    std::string judged = "has the same order";
    if (std::isfinite(effect.amplitude)) {
      const bool within = effect.amplitude >= amplitude.low && effect.amplitude <= amplitude.high;
      judged = within ? "agrees with it" : "has the same order and another amplitude";
    }
    own.remarks.push_back(
        fmt::format("The equations have {}; the torque at full rate {}: {:.3g} N m "
                    "({:.3g} to {:.3g}).",
                    words, judged, amplitude.value, amplitude.low, amplitude.high));
    return;
  }
  if (!own.result.judged || effect.order < own.result.least_order ||
      effect.order > own.result.most_order) {
    own.remarks.push_back(fmt::format(
        "The equations have {}; the torque at full rate was not looked at there.", words));
    return;
  }
  own.remarks.push_back(
      fmt::format("The equations have {}; the torque at full rate does not show it.", words));
}

/// Pieces of one run, one after the other.
RippleRun run_of(const LinearModel& model, const VectorXd& beta,
                 const std::vector<Motion>& pieces) {
  constexpr Index kBlock = 4096;  // samples of which the regressor is held at once
  Index count = 0;
  for (const Motion& motion : pieces) count += motion.samples();
  RippleRun run;
  run.sample_time = pieces.back().sample_time;
  for (MatrixXd* part : {&run.q, &run.dq, &run.ddq, &run.residual}) {
    part->resize(count, model.joints());
  }
  Index at = 0;
  for (const Motion& motion : pieces) {
    const Index rows = motion.samples();
    run.q.middleRows(at, rows) = motion.q;
    run.dq.middleRows(at, rows) = motion.dq;
    run.ddq.middleRows(at, rows) = motion.ddq;
    for (Index first = 0; first < rows; first += kBlock) {
      const Index part = std::min(kBlock, rows - first);
      run.residual.middleRows(at + first, part) =
          motion.tau.middleRows(first, part) -
          model.torque(motion.q.middleRows(first, part), motion.dq.middleRows(first, part),
                       motion.ddq.middleRows(first, part), beta);
    }
    at += rows;
  }
  return run;
}

}  // namespace

std::vector<RippleRun> ripple_runs(const LinearModel& model, const VectorXd& beta,
                                   const std::vector<MotionSource>& sources) {
  std::vector<RippleRun> runs;
  Index samples = 0;
  for (const MotionSource& source : sources) {
    if (!source.recorded) continue;
    std::vector<std::vector<Motion>> found;  // pieces of each run
    bool left_out = false;
    source.pieces([&](const StreamPiece& piece) {
      left_out = samples >= kMostRippleSamples;
      if (left_out) return;
      if (!piece.continues_run || found.empty()) found.emplace_back();
      samples += piece.motion.samples();
      found.back().push_back(piece.motion);
    });
    for (const std::vector<Motion>& pieces : found) {
      runs.push_back(run_of(model, beta, pieces));
      for (std::size_t j = 0; j < source.condition.torque_dead.size(); ++j) {
        if (!source.condition.torque_dead[j]) continue;
        runs.back().residual.col(static_cast<Index>(j)).setConstant(kNoNumber);
      }
    }
    if (!left_out) continue;
    runs.back().cut_off = true;
    break;
  }
  return runs;
}

std::vector<RippleRun> ripple_runs(const EffectRecordings& data, const EffectPoint& point) {
  EffectPoint slow = point;
  slow.initial.clear();
  std::erase_if(slow.effects, is_ripple);
  slow = at_rest(data, slow.beta, slow.effects);
  const RunResiduals residuals = raw_residuals(data, slow);
  std::vector<RippleRun> runs;
  Index samples = 0;
  for (std::size_t i = 0; i < data.runs.size() && samples < kMostRippleSamples; ++i) {
    const Motion& motion = data.runs[i].motion;
    runs.push_back({motion.sample_time, motion.q, motion.dq, motion.ddq, residuals[i]});
    samples += motion.samples();
    runs.back().cut_off = samples >= kMostRippleSamples && i + 1 < data.runs.size();
    for (int j = 0; j < data.joints(); ++j) {
      if (data.is_masked(j)) runs.back().residual.col(j).setConstant(kNoNumber);
    }
  }
  return runs;
}

std::vector<EffectRipple> ripples_in(const std::vector<EffectInstance>& effects) {
  std::vector<EffectRipple> ripples;
  for (const EffectInstance& effect : effects) {
    if (!is_ripple(effect)) continue;
    const auto n = parameter_of(effect, "n"), gear = parameter_of(effect, "gear"),
               poles = parameter_of(effect, "poles");
    std::vector<double> orders;
    if (n) orders = {*n};
    if (!n && gear && poles) {
      const double turns = *gear * *poles;
      orders = {effect.law.name == "commutation_deadtime" ? 6 * turns
                : effect.law.name == "commutation_gain"   ? 2 * turns
                                                          : turns};
    } else if (!n && gear) {
      orders = {2 * *gear, 4 * *gear, *gear};
    }
    for (const double order : orders) {
      EffectRipple own{effect.joint, effect.law.name, order, kNoNumber, kNoNumber};
      const auto a = parameter_of(effect, "a"), b = parameter_of(effect, "b");
      if (a && b && effect.law.name == "cogging") {
        own.amplitude = std::hypot(*a, *b);
        own.phase = std::atan2(*b, *a);
      }
      ripples.push_back(std::move(own));
    }
  }
  return ripples;
}

JointRipples ripples_of(const LinearModel& model, const std::vector<RippleRun>& all_runs,
                        const std::vector<double>& gears, const std::vector<EffectRipple>& effects,
                        const RippleRules& rules, ProgressLine& progress) {
  JointRipples answer;
  std::vector<RippleRun> runs;
  constexpr double kSame = 1e-3;
  for (const RippleRun& run : all_runs) {
    if (run.q.rows() == 0) continue;
    if (!runs.empty() && std::abs(run.sample_time / runs.front().sample_time - 1) > kSame) {
      if (answer.remarks.empty()) {
        answer.remarks.emplace_back(
            "Ripple is sought in the recordings that have the sample time of the first.");
      }
      continue;
    }
    runs.push_back(run);
  }
  if (runs.empty()) return answer;
  Index samples = 0;
  for (const RippleRun& run : all_runs) samples += run.q.rows();
  if (all_runs.back().cut_off) {
    answer.remarks.push_back(fmt::format(
        "Ripple is sought in the first {} samples; the others are left out for time.", samples));
  }
  for (int j = 0; j < model.joints(); ++j) {
    const auto place = static_cast<std::size_t>(j);
    progress.show(fmt::format("ripple of joint {}", j + 1), place,
                  static_cast<std::size_t>(model.joints()));
    JointRipple own;
    if (model.revolute[place]) {
      RippleData data = joint_data(runs, j);
      data.gear_ratio = place < gears.size() ? gears[place] : 0;
      for (int m = 1; data.gear_ratio != 0 && m <= kStatedMultiples; ++m) {
        data.stated.push_back(m * std::abs(data.gear_ratio));
      }
      own.result = analyse_ripple(data, rules);
    } else {
      own.result.why_not = "The joint slides: it has no turns to count periods in.";
    }
    own.result.joint = j;
    own.found_as.resize(own.result.lines.size());
    for (const EffectRipple& effect : effects) {
      if (effect.joint == j) compare(own, effect);
    }
    answer.joints.push_back(std::move(own));
  }
  return answer;
}

bool makes_row(const JointRipple& ripple, std::size_t line) {
  constexpr double kMostOrder = 1000;  // of the effect's parameter n
  const RippleLine& own = ripple.result.lines[line];
  return own.kind == RippleKind::kTorque && ripple.found_as[line].empty() &&
         own.order.value <= kMostOrder && is_shared(own);
}

std::vector<EffectInstance> ripple_effects(const JointRipples& ripples, const RobotModel& model,
                                           const EffectCatalogue& catalogue) {
  std::vector<EffectInstance> effects;
  const auto file = catalogue.find("cogging");
  if (!file) return effects;
  const EffectLaw law = effect_law(*file);
  for (const JointRipple& own : ripples.joints) {
    for (std::size_t i = 0; i < own.result.lines.size(); ++i) {
      const RippleLine& line = own.result.lines[i];
      if (!makes_row(own, i)) continue;
      EffectInstance effect;
      effect.law = law;
      effect.joint = own.result.joint;
      for (std::size_t k = 0; k < model.joints.size(); ++k) {
        if (model.joints[k].coordinate == effect.joint) effect.link = static_cast<int>(k) + 1;
      }
      effect.parameters.resize(law.size());
      for (int p = 0; p < law.size(); ++p) {
        const std::string& name = law.parameters[static_cast<std::size_t>(p)].name;
        const RippleWave& wave = line.both;
        effect.parameters[p] = name == "a"   ? wave.amplitude.value * std::cos(wave.phase.value)
                               : name == "b" ? wave.amplitude.value * std::sin(wave.phase.value)
                                             : line.order.value;
      }
      effects.push_back(std::move(effect));
    }
  }
  return effects;
}

}  // namespace dyngen::runtime
