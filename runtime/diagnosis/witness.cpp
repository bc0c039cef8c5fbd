// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/witness.h"

#include <algorithm>
#include <cmath>

#include "runtime/diagnosis/heldout.h"

namespace dyngen::runtime {
namespace {

constexpr double kChance = 1e-3;  // that what is there is contradicted
constexpr double kPart = 0.25;    // of its squares: half of its size
constexpr double kSeen = 0.4;     // of its squares, at the motion of the other periods

bool is_linear(const Hypothesis& hypothesis) {
  return !hypothesis.windowed &&
         std::all_of(hypothesis.linear.begin(), hypothesis.linear.end(), [&](int p) {
           return hypothesis.effect.law.parameters[static_cast<std::size_t>(p)].role ==
                  EffectRole::kLinear;
         });
}

/// Whether columns have more to explain than noise, and more than a part of what was said.
bool wants_other(const Products& products, double said) {
  const Score wanted = score_of(products, false);
  return std::exp(-surprise_of(wanted.squares, wanted.degrees)) <= kChance &&
         wanted.squares > kPart * said;
}

}  // namespace

Witness::Witness(const EffectRecordings& data, Kind kind)
    : data_(data), kind_(kind), signals_(data), repeats_(repeats_of(data)) {}

/// Whether it sees too little of what was explained.
bool Witness::misses(double seen, double squares) const {
  return kind_ == Kind::kRepeated && seen < kSeen * squares;
}

EvidenceSystem Witness::system(const std::vector<Hypothesis>& hypotheses,
                               const CompetitionResult& result, const EffectPoint& point,
                               EvidenceSystem::Options options) {
  std::vector<Hypothesis> beside;
  for (const Winner& winner : result.winners) beside.push_back(hypotheses[winner.hypothesis]);
  const TorqueNoiseModel noise =
      torque_noise_model(data_, residuals_of(data_, point), repeats_, options.with_regressor);
  options.surrogates = 0;
  EvidenceSystem system = system_at(data_, signals_, point, beside, noise, options);
  add_nameless(data_, signals_, result, system);
  return system;
}

bool Witness::contradicts(const std::vector<Hypothesis>& hypotheses,
                          const CompetitionResult& result, const Hypothesis& hypothesis,
                          const EffectPoint& point, double squares,
                          EvidenceSystem::Options options) {
  if (hypothesis.windowed) return false;
  const EvidenceSystem own = system(hypotheses, result, point, options);
  const EffectInstance& effect = point.effects.back();
  const Products whole =
      own.products(own.whitened(effect_columns(data_, signals_, effect, {0})), false);
  const double said = whole.left.trace();
  if (said > 0 && misses(std::pow(whole.rest[0] + said, 2) / said, squares)) return true;
  return is_linear(hypothesis) &&
         wants_other(
             own.products(hypothesis_columns(data_, signals_, own, hypothesis, effect), false),
             said);
}

bool Witness::contradicts(const std::vector<Hypothesis>& hypotheses,
                          const CompetitionResult& result, const Nameless& nameless,
                          EvidenceSystem::Options options) {
  const EvidenceSystem own = system(hypotheses, result, result.fit.point, options);
  Products products =
      own.products(own.whitened(nameless_columns(data_, signals_, nameless)), false);
  const Eigen::VectorXd& size = nameless.score.coefficients;
  if (size.size() != products.rest.size()) return false;
  if (misses(score_of(products, false).squares, nameless.score.squares)) return true;
  const Eigen::VectorXd as_said = products.left * size;
  products.rest -= as_said;
  return wants_other(products, size.dot(as_said));
}

}  // namespace dyngen::runtime
