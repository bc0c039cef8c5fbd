// SPDX-License-Identifier: MIT
/// Effects of recordings that do not repeat, ordered by the likelihoods of their fits.
#include "runtime/diagnosis/competition/likely_search.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "runtime/estimation/decompositions.h"
#include "tests/runtime/diagnosis/arm_competition.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

/// A spring of joint 2 whose stiffness has a unit of its own: its column is that of any other
/// spring, but for rounding.
EffectInstance spring_in_units_of(const std::string& name, double unit) {
  EffectInstance effect = test::unknown(
      test::algebraic_law(
          name, {"q"}, {{"k", EffectRole::kLinear, -100, 100, 0.1, 0.3}},
          [unit](const VectorXd& v, const VectorXd& p) { return unit * (p[0] * v[0]); }),
      1);
  effect.law.family = name;
  effect.link = 2;
  return effect;
}

using FitWith = std::function<EffectFit(const EffectRecordings&, const EffectInstance&)>;

/// Names in the order in which effects are offered, none of which is taken.
std::vector<std::string> offered(
    const std::vector<EffectInstance>& effects, const FitWith& with,
    const std::function<bool()>& exhausted = [] { return false; }) {
  const EffectInstance truth = test::known(test::spring_law(), 1, {0.4});
  test::ArmCompetition arm(test::everywhere({truth}));
  std::vector<Hypothesis> hypotheses;
  for (const EffectInstance& effect : effects) hypotheses.push_back(arm.hypothesis(effect));
  const Sought sought = sought_in(arm.evidence, hypotheses);
  const CompetitionResult result = arm.nothing_found();
  ScreeningData screened(arm.evidence);
  const EvidenceSystem system = system_beside(arm.evidence, arm.signals, hypotheses, result,
                                              result.fit.point, result.noise, {});
  const Screening screening =
      screen(screened, system, sought.scales, result.fit.point.beta, hypotheses, {}, nullptr);
  LikelySearch search(
      arm.data, sought, screened, result,
      {[&](const EffectInstance& effect) { return with(arm.evidence, effect); }, exhausted});
  std::vector<std::string> names;
  const auto refuse = [&](const LikelyEffect& likely) {
    names.push_back(likely.named.best.effect.law.name);
    return false;
  };
  EXPECT_FALSE(search.next({system, screening}, {system, screening}, refuse));
  return names;
}

EffectFit fit_with(const EffectRecordings& data, const EffectInstance& effect) {
  return fit_effects(data, {effect});
}

TEST(LikelySearch, OffersTheFirstOfEqualColumnsFirst) {
  for (const double unit : {3.0, 0.7, 1.1}) {
    const EffectInstance plain = spring_in_units_of("plain", 1),
                         other = spring_in_units_of("other", unit);
    EXPECT_EQ(offered({plain, other}, fit_with), (std::vector<std::string>{"plain", "other"}))
        << unit;
    EXPECT_EQ(offered({other, plain}, fit_with), (std::vector<std::string>{"other", "plain"}))
        << unit;
  }
}

TEST(LikelySearch, OffersNoEffectWithoutAFiniteFit) {
  const std::vector<EffectInstance> effects = {spring_in_units_of("broken", 1),
                                               spring_in_units_of("whole", 2)};
  const auto broken = [](const EffectRecordings& data, const EffectInstance& effect) {
    if (effect.law.name == "broken") throw NotFiniteError("no finite torque");
    return fit_with(data, effect);
  };
  EXPECT_EQ(offered(effects, broken), std::vector<std::string>{"whole"});
}

TEST(LikelySearch, FitsNothingOnceTheWorkIsDone) {
  int fits = 0;
  const auto counted = [&](const EffectRecordings& data, const EffectInstance& effect) {
    ++fits;
    return fit_with(data, effect);
  };
  EXPECT_TRUE(offered({spring_in_units_of("spring", 1)}, counted, [] { return true; }).empty());
  EXPECT_EQ(fits, 0);
  EXPECT_EQ(offered({spring_in_units_of("spring", 1)}, counted).size(), 1U);
  EXPECT_EQ(fits, 1);
}

TEST(LikelySearch, PassesOnWhatTheCallerDidWrong) {
  const auto wrong = [](const EffectRecordings&, const EffectInstance&) -> EffectFit {
    throw std::invalid_argument("shapes do not fit");
  };
  EXPECT_THROW(offered({spring_in_units_of("spring", 1)}, wrong), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
