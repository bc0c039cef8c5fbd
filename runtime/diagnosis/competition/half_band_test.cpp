// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/half_band_test.h"

#include <algorithm>
#include <cmath>

#include "runtime/diagnosis/competition/heldout.h"

namespace dyngen::runtime {
namespace {

constexpr double kContradictedChance = 1e-3;  // that what is there is contradicted
constexpr double kPart = 0.25;                // of its squares: half of its size

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
  return std::exp(-surprise_of(wanted.delta_chi2, wanted.degrees)) <= kContradictedChance &&
         wanted.delta_chi2 > kPart * said;
}

}  // namespace

HalfBandTest::HalfBandTest(const EffectRecordings& data)
    : data_(data), signals_(data), repeats_(repeats_of(data)) {}

EvidenceSystem HalfBandTest::system(const std::vector<Hypothesis>& hypotheses,
                                    const CompetitionResult& result, const EffectPoint& point,
                                    EvidenceSystem::Options options) {
  const TorqueNoiseModel noise = torque_noise_model(data_, residuals_of(data_, point), repeats_,
                                                    options.with_regressor, options.rules.noise);
  options.surrogates = 0;
  return system_beside(data_, signals_, hypotheses, result, point, noise, options);
}

bool HalfBandTest::contradicts(const std::vector<Hypothesis>& hypotheses,
                               const CompetitionResult& result, const Hypothesis& hypothesis,
                               const EffectPoint& point, EvidenceSystem::Options options) {
  if (!is_linear(hypothesis)) return false;
  const EvidenceSystem own = system(hypotheses, result, point, options);
  const EffectInstance& effect = point.effects.back();
  const Products whole =
      own.products(own.whitened(effect_columns(data_, signals_, effect, {0})), false);
  return wants_other(
      own.products(hypothesis_columns(data_, signals_, own, hypothesis, effect), false),
      whole.left.trace());
}

bool HalfBandTest::contradicts(const std::vector<Hypothesis>& hypotheses,
                               const CompetitionResult& result, const Nameless& nameless,
                               EvidenceSystem::Options options) {
  const EvidenceSystem own = system(hypotheses, result, result.fit.point, options);
  Products products =
      own.products(own.whitened(nameless_columns(data_, signals_, nameless)), false);
  const Eigen::VectorXd& size = nameless.score.coefficients;
  if (size.size() != products.rest.size()) return false;
  const Eigen::VectorXd as_said = products.left * size;
  products.rest -= as_said;
  return wants_other(products, size.dot(as_said));
}

}  // namespace dyngen::runtime
