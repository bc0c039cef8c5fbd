// SPDX-License-Identifier: MIT
#include "runtime/effects/effect_start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "runtime/effects/equation_stack.h"
#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Values of a parameter between its bounds; around the start where a bound is missing.
std::vector<double> grid_of(const EffectParameter& parameter, double min, double max, double start,
                            int count) {
  constexpr double kAround = 10;
  const bool bounded = std::isfinite(min) && std::isfinite(max) && max > min;
  if (!bounded || (parameter.logarithmic && !(min > 0))) {
    if (start == 0) return {start};
    const double low = std::min(start / kAround, start * kAround);
    const double high = std::max(start / kAround, start * kAround);
    min = std::max(min, low);
    max = std::min(max, high);
  }
  const bool logarithmic = parameter.logarithmic && min > 0;
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const double part = count > 1 ? static_cast<double>(i) / (count - 1) : 0.5;
    values.push_back(logarithmic ? min * std::pow(max / min, part) : min + part * (max - min));
  }
  values.push_back(start);
  return values;
}

/// Squares that are left of `rest` when an effect's linear parameters are fitted to it.
class Trial {
 public:
  Trial(EffectSignals& signals, const EquationStack& stack, const Projection& others, VectorXd rest)
      : signals_(signals), stack_(stack), others_(others), rest_(std::move(rest)) {}

  [[nodiscard]] double cost(const EffectInstance& effect) const {
    const MatrixXd all = stack_.stacked(signals_, effect);
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
};

void check_joints(const EffectInstance& effect, int joints) {
  const EffectLaw& law = effect.law;
  const bool joint_good =
      effect.joint < joints && (effect.joint >= 0 || law.scope == EffectScope::kRobot);
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
    const VectorXd start = effect.law.sizes(scales.of(beta, effect)).start;
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
  const Trial trial(signals, stack, projection, projection.rest(equations.rightCols(1)));

  const EffectSizes sizes = law.sizes(scales.of(point.beta, effect));
  std::vector<VectorXd> starts;
  for (const Index p : tried) {
    const EffectParameter& parameter = law.parameters[static_cast<std::size_t>(p)];
    const bool scan = parameter.role == EffectRole::kScanned;
    std::vector<std::pair<double, double>> costs;  // and values
    for (const double value : grid_of(parameter, sizes.min[p], sizes.max[p], effect.parameters[p],
                                      scan ? std::max(2, parameter.grid) : grid)) {
      EffectInstance candidate = effect;
      candidate.parameters[p] = value;
      costs.emplace_back(trial.cost(candidate), value);
    }
    std::stable_sort(costs.begin(), costs.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    effect.parameters[p] = costs.front().second;
    for (std::size_t i = 1; scan && i < costs.size() && static_cast<int>(i) < refined; ++i) {
      starts.push_back(effect.parameters);
      starts.back()[p] = costs[i].second;
    }
  }
  starts.insert(starts.begin(), effect.parameters);
  return starts;
}

}  // namespace dyngen::runtime
