// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/effects/equation_stack.h"
#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMostValues = 4000;  // of a grid

/// Values at which shapes of an effect are tried.
class Grids {
 public:
  /// @param start  of all parameters       @param count  values of a shape that is not scanned
  Grids(const EffectLaw& law, const EffectScales& scales, VectorXd start, int count)
      : law_(law), sizes_(law.sizes(scales)), start_(std::move(start)), count_(count) {}

  /// Between the bounds; around the start where a bound is missing. `also` is one of them.
  [[nodiscard]] std::vector<double> values(Index p, double also) const {
    std::vector<double> result = spread(p, count_of(p));
    result.push_back(also);
    return result;
  }
  /// A few of them.
  [[nodiscard]] std::vector<double> few(Index p) const { return spread(p, 20); }
  /// Between neighbours.
  [[nodiscard]] double step(Index p, double value) const {
    const auto [low, high, logarithmic] = range(p);
    const double parts = std::max(1, count_of(p) - 1);
    return logarithmic ? value * (std::pow(high / low, 1 / parts) - 1) : (high - low) / parts;
  }

 private:
  struct Range {
    double low, high;
    bool logarithmic;
  };

  [[nodiscard]] const EffectParameter& parameter(Index p) const {
    return law_.parameters[static_cast<std::size_t>(p)];
  }
  [[nodiscard]] int count_of(Index p) const {
    if (parameter(p).role != EffectRole::kScanned) return count_;
    return std::clamp(parameter(p).grid, 2, kMostValues);
  }
  [[nodiscard]] Range range(Index p) const {
    constexpr double kAround = 10;
    double low = sizes_.min[p], high = sizes_.max[p];
    const double start = start_[p];
    const bool bounded = std::isfinite(low) && std::isfinite(high) && high > low;
    if (!bounded || (parameter(p).logarithmic && !(low > 0))) {
      low = std::max(low, std::min(start / kAround, start * kAround));
      high = std::min(high, std::max(start / kAround, start * kAround));
    }
    return {low, high, parameter(p).logarithmic && low > 0};
  }
  [[nodiscard]] std::vector<double> spread(Index p, int count) const {
    const auto [low, high, logarithmic] = range(p);
    std::vector<double> result;
    for (int i = 0; i < count; ++i) {
      const double part = count > 1 ? static_cast<double>(i) / (count - 1) : 0.5;
      result.push_back(logarithmic ? low * std::pow(high / low, part) : low + part * (high - low));
    }
    return result;
  }

  const EffectLaw& law_;
  EffectSizes sizes_;
  VectorXd start_;
  int count_;
};

/// Whether no linear parameter has a part in a condition.
bool of_shapes_alone(const EffectInstance& effect, const EffectCondition& condition) {
  const double slack = condition.slack(effect.parameters, {});
  for (Index p = 0; p < effect.law.size(); ++p) {
    if (effect.law.parameters[static_cast<std::size_t>(p)].role != EffectRole::kLinear) continue;
    VectorXd moved = effect.parameters;
    moved[p] += 1;
    if (condition.slack(moved, {}) != slack) return false;
  }
  return true;
}

/// The sum of squares of `rest` after a fit of an effect's linear parameters to it.
class StartTrial {
 public:
  StartTrial(EffectSignals& signals, const EquationStack& stack, const Projection& others,
             VectorXd rest, const EffectScales& scales)
      : signals_(signals),
        stack_(stack),
        others_(others),
        rest_(std::move(rest)),
        scales_(scales) {}

  /// Infinite where a requirement on shapes alone is not met.
  [[nodiscard]] double cost(const EffectInstance& effect) const {
    for (const EffectCondition& condition : effect.law.requirements) {
      if (of_shapes_alone(effect, condition) && condition.slack(effect.parameters, scales_) < 0) {
        return std::numeric_limits<double>::infinity();
      }
    }
    const MatrixXd all = stack_.whitened(stack_.plain(signals_, effect));
    if (!all.allFinite()) return std::numeric_limits<double>::infinity();
    std::vector<Index> linear;
    VectorXd fixed = all.col(0);
    for (Index p = 0; p < effect.law.size(); ++p) {
      if (effect.law.parameters[static_cast<std::size_t>(p)].role != EffectRole::kLinear) continue;
      linear.push_back(1 + p);
      fixed -= effect.parameters[p] * all.col(1 + p);
    }
    const VectorXd wanted = rest_ - others_.rest(fixed);
    if (linear.empty()) return wanted.squaredNorm();
    const MatrixXd columns = others_.rest(all(Eigen::all, linear));
    return (wanted - columns * least_norm_solution(columns, wanted)).squaredNorm();
  }

 private:
  EffectSignals& signals_;
  const EquationStack& stack_;
  const Projection& others_;
  VectorXd rest_;
  EffectScales scales_;
};

EffectInstance with_value(EffectInstance effect, Index p, double value) {
  effect.parameters[p] = value;
  return effect;
}

/// Of two scanned parameters that mean something together only: the beginning and end of a window.
VectorXd best_pair(const StartTrial& trial, const Grids& grids, const EffectInstance& effect,
                   Index p, Index r) {
  VectorXd best = effect.parameters;
  double least = std::numeric_limits<double>::infinity();
  for (const double first : grids.few(p)) {
    for (const double second : grids.few(r)) {
      EffectInstance candidate = with_value(with_value(effect, p, first), r, second);
      const double cost = trial.cost(candidate);
      if (!(cost < least)) continue;
      least = cost;
      best = candidate.parameters;
    }
  }
  return best;
}

/// The best value within a step of the effect's: looked for on both sides, ever closer.
double closer(const StartTrial& trial, const EffectInstance& effect, Index p, double cost,
              double step) {
  constexpr int kHalvings = 7;
  double best = effect.parameters[p];
  for (int i = 0; i < kHalvings; ++i) {
    step /= 2;
    const double here = best;
    for (const double value : {here - step, here + step}) {
      const double next = trial.cost(with_value(effect, p, value));
      if (!(next < cost)) continue;
      cost = next;
      best = value;
    }
  }
  return best;
}

void check_joints(const EffectInstance& effect, int joints) {
  const EffectLaw& law = effect.law;
  // a force on a link that does not move by itself has no joint
  const bool whole = law.scope == EffectScope::kRobot || (law.acts_on_all && effect.link > 0);
  const bool joint_good = effect.joint < joints && (effect.joint >= 0 || whole);
  const bool other_good = effect.other < joints && effect.other != effect.joint &&
                          (effect.other >= 0 || law.scope != EffectScope::kPair);
  if (joint_good && (other_good || law.scope != EffectScope::kPair) &&
      effect.parameters.size() == law.size()) {
    return;
  }
  throw std::invalid_argument(fmt::format(
      "effect {}: joint {}, other {} and {} parameters, expected {} parameters and joints of 1..{}",
      law.name, effect.joint + 1, effect.other + 1, effect.parameters.size(), law.size(), joints));
}

}  // namespace

std::vector<EffectInstance> with_starts(const ScaleTable& scales, const VectorXd& beta,
                                        std::vector<EffectInstance> effects) {
  for (EffectInstance& effect : effects) {
    check_joints(effect, scales.model().joints());
    const EffectScales own = scales.of(beta, effect);
    const int slow = slower_than_recording(effect.law, own);
    if (slow >= 0 && std::isnan(effect.parameters[slow])) {
      throw std::invalid_argument(
          fmt::format("effect {}: no {} is within its bounds in recordings of {:.3g} s: expected a "
                      "number, or a "
                      "longer recording",
                      effect.law.name, effect.law.parameters[static_cast<std::size_t>(slow)].name,
                      own.duration));
    }
    const VectorXd start = effect.law.sizes(own).start;
    for (Index p = 0; p < effect.law.size(); ++p) {
      const EffectParameter& parameter = effect.law.parameters[static_cast<std::size_t>(p)];
      if (!std::isnan(effect.parameters[p])) continue;
      if (parameter.role == EffectRole::kGiven && !std::isfinite(start[p])) {
        throw std::invalid_argument(
            fmt::format("effect {}: {} has no number, and it is a property of the machine that is "
                        "not estimated: expected {}=",
                        effect.law.name, parameter.name, parameter.name));
      }
      effect.parameters[p] = start[p];
    }
  }
  return effects;
}

std::vector<VectorXd> start_values(const EffectRecordings& data, EffectSignals& signals,
                                   const ScaleTable& scales, const EffectPoint& point,
                                   std::size_t place, const EffectInstance& as_written,
                                   const VectorXd& joint_weights, int grid, int refined) {
  EffectInstance effect = point.effects[place];
  const EffectLaw& law = effect.law;
  // scanned ones first: they have many local minima
  std::vector<Index> tried;
  bool scanned = false;
  for (const EffectRole role : {EffectRole::kScanned, EffectRole::kShape}) {
    for (Index p = 0; p < law.size(); ++p) {
      if (law.parameters[static_cast<std::size_t>(p)].role != role) continue;
      if (!std::isnan(as_written.parameters[p])) continue;
      tried.push_back(p);
      scanned = scanned || role == EffectRole::kScanned;
    }
  }
  if (tried.empty() || law.kind == EffectKind::kAlignment) return {effect.parameters};

  // the other unknowns, with this effect left out
  EffectPoint others = point;
  others.effects.erase(others.effects.begin() + static_cast<std::ptrdiff_t>(place));
  for (auto& run : others.initial) run.erase(run.begin() + static_cast<std::ptrdiff_t>(place));
  EffectUnknowns unknowns = base_unknowns(others);
  for (std::size_t k = 0; k < others.effects.size(); ++k) {
    const auto& parameters = others.effects[k].law.parameters;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      if (parameters[p].role == EffectRole::kLinear) unknowns.parameters[k][p] = unknowns.size++;
    }
  }
  const EquationStack stack(data, Whitening::by_weights(joint_weights));
  MatrixXd equations = stack.stacked(linearised(data, signals, others, unknowns));
  const Projection projection(equations.leftCols(unknowns.size));
  const StartTrial trial(signals, stack, projection, projection.rest(equations.rightCols(1)),
                         scales.of(point.beta, effect));

  const Grids grids(law, scales.of(point.beta, effect), effect.parameters, grid);
  if (tried.size() > 1 &&
      law.parameters[static_cast<std::size_t>(tried[1])].role == EffectRole::kScanned) {
    effect.parameters = best_pair(trial, grids, effect, tried[0], tried[1]);
  }
  std::vector<VectorXd> starts;
  for (const Index p : tried) {
    const bool scan = law.parameters[static_cast<std::size_t>(p)].role == EffectRole::kScanned;
    std::vector<std::pair<double, double>> costs;  // and values
    for (const double value : grids.values(p, effect.parameters[p])) {
      costs.emplace_back(trial.cost(with_value(effect, p, value)), value);
    }
    std::stable_sort(costs.begin(), costs.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    effect.parameters[p] = costs.front().second;
    for (std::size_t i = 1; scan && i < costs.size() && static_cast<int>(i) < refined; ++i) {
      starts.push_back(effect.parameters);
      starts.back()[p] = costs[i].second;
    }
    if (scan) {
      effect.parameters[p] =
          closer(trial, effect, p, costs.front().first, grids.step(p, effect.parameters[p]));
    }
  }
  starts.insert(starts.begin(), effect.parameters);
  return starts;
}

}  // namespace dyngen::runtime
