// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/names/effect_location.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "runtime/diagnosis/scans/generic_structure.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = StructureVariable::Kind;

constexpr double kShare = 0.7;
constexpr double kSpread = 0.4;  // of the samples: with more the range says nothing

struct Range {
  double from = 0, to = 0;
  double share = 0;    // of the energy
  double samples = 1;  // part of the samples
};

/// The shortest run of samples, sorted by the variable, with the share of the energy.
Range closest_range(const VectorXd& x, const VectorXd& energy) {
  std::vector<Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return x[a] < x[b]; });
  const double wanted = kShare * energy.sum();
  Range best{x.minCoeff(), x.maxCoeff(), 1, 1};
  double inside = 0;
  std::size_t from = 0;
  for (std::size_t to = 0; to < order.size(); ++to) {
    inside += energy[order[to]];
    while (inside - energy[order[from]] >= wanted) inside -= energy[order[from++]];
    if (inside < wanted) continue;
    const double samples = static_cast<double>(to + 1 - from) / static_cast<double>(order.size());
    if (samples < best.samples) {
      best = {x[order[from]], x[order[to]], inside / energy.sum(), samples};
    }
  }
  return best;
}

}  // namespace

LocatedEffect located(const EffectRecordings& data, EffectSignals& signals,
                      const EvidenceSystem& system, const Hypothesis& hypothesis,
                      const EffectInstance& effect) {
  const JointColumns columns = system.whitened(effect_columns(data, signals, effect, {0}));
  int joint = columns.joints.front();
  VectorXd energy, squares = VectorXd::Zero(data.joints());
  for (const int j : columns.joints) {
    const VectorXd here = system.left_of(columns, j).col(0).cwiseAbs2();
    squares[j] = here.sum();
    if (energy.size() != 0 && here.sum() <= energy.sum()) continue;
    energy = here;
    joint = j;
  }
  std::vector<StructureVariable> variables = {{Kind::kVelocity, joint},
                                              {Kind::kPosition, joint},
                                              {Kind::kLoad, joint},
                                              {Kind::kDistance, joint},
                                              {Kind::kTime, -1}};
  if (effect.other >= 0) variables.push_back({Kind::kVelocity, effect.other});
  EffectLocation where;
  double least = std::numeric_limits<double>::infinity();
  for (const StructureVariable& variable : variables) {
    const Range range = closest_range(values_at_equations(data, signals, variable), energy);
    if (range.samples >= least) continue;
    least = range.samples;
    where.variable = variable_name(variable);
    where.from = range.from;
    where.to = range.to;
    where.share = range.share;
  }
  if (least > kSpread) {
    // spread over everything: the variable that the effect is about, from end to end
    const auto& read = effect.law.variables;
    const auto reads = [&](const char* name) {
      return std::find(read.begin(), read.end(), name) != read.end();
    };
    const StructureVariable variable = reads("q") ? StructureVariable{Kind::kPosition, joint}
                                       : reads("tau_load") ? StructureVariable{Kind::kLoad, joint}
                                       : reads("t")        ? StructureVariable{Kind::kTime, -1}
                                                    : StructureVariable{Kind::kVelocity, joint};
    const VectorXd x = values_at_equations(data, signals, variable);
    where.variable = variable_name(variable);
    where.from = x.minCoeff();
    where.to = x.maxCoeff();
    where.share = 1;
    where.spread = true;
  }
  if (hypothesis.windowed) {
    where.t_from = effect.parameters[hypothesis.shapes.front()];
    double end = 0;
    for (const EffectRun& run : data.runs) end = std::max(end, run.time[run.time.size() - 1]);
    where.t_to = hypothesis.shapes.size() > 1 ? effect.parameters[hypothesis.shapes.back()] : end;
  }
  return {std::move(where), joint, std::move(squares)};
}

}  // namespace dyngen::runtime
