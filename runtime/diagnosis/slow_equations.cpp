// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/slow_equations.h"

#include <algorithm>
#include <cmath>

#include "runtime/diagnosis/heldout.h"

namespace dyngen::runtime {
namespace {

constexpr double kChance = 1e-3;  // that a right name is contradicted
constexpr double kPart = 0.25;    // of the effect's squares: half of its size

bool is_linear(const Hypothesis& hypothesis) {
  return !hypothesis.windowed &&
         std::all_of(hypothesis.linear.begin(), hypothesis.linear.end(), [&](int p) {
           return hypothesis.effect.law.parameters[static_cast<std::size_t>(p)].role ==
                  EffectRole::kLinear;
         });
}

}  // namespace

SlowEquations::SlowEquations(const EffectRecordings& data)
    : data_(data), signals_(data), repeats_(repeats_of(data)) {}

bool SlowEquations::contradict(const std::vector<Hypothesis>& hypotheses,
                               const CompetitionResult& result, const Hypothesis& hypothesis,
                               const EffectPoint& point, EvidenceSystem::Options options) {
  if (!is_linear(hypothesis)) return false;
  std::vector<Hypothesis> beside;
  for (const Winner& winner : result.winners) beside.push_back(hypotheses[winner.hypothesis]);
  const TorqueNoiseModel noise =
      torque_noise_model(data_, residuals_of(data_, point), repeats_, options.with_regressor);
  options.surrogates = 0;
  EvidenceSystem system = system_at(data_, signals_, point, beside, noise, options);
  add_nameless(data_, signals_, result, system);
  const EffectInstance& effect = point.effects.back();
  const Score wanted = score_of(
      system.products(hypothesis_columns(data_, signals_, system, hypothesis, effect), false),
      false);
  if (std::exp(-surprise_of(wanted.squares, wanted.degrees)) > kChance) return false;
  const Products whole =
      system.products(system.whitened(effect_columns(data_, signals_, effect, {0})), false);
  return wanted.squares > kPart * whole.left.trace();
}

}  // namespace dyngen::runtime
