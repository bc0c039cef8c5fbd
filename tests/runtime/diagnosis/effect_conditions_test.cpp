// SPDX-License-Identifier: MIT
/// What an effect has to be beside the structure that has no name.
#include "runtime/diagnosis/competition/effect_conditions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/runtime/diagnosis/arm_competition.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

/// A push on joint 1 between two times.
EffectLaw timed_push() {
  EffectLaw law = test::algebraic_law(
      "timed_push", {"t"},
      {{"size", EffectRole::kLinear, -10, 10, 0, 1},
       {"t1", EffectRole::kScanned, 0, 60, 5, 5, false, 20},
       {"t2", EffectRole::kScanned, 0, 60, 15, 15, false, 20}},
      [](const VectorXd& v, const VectorXd& p) { return v[0] >= p[1] && v[0] < p[2] ? p[0] : 0; });
  for (const std::size_t time : {1U, 2U}) law.parameters[time].unit = "s";
  return law;
}

/// A spring of joint 2 and a push on joint 1, beside structures whose scores a test sets.
struct ConditionScene {
  ConditionScene()
      : arm(test::everywhere({test::known(timed_push(), 0, {0.5, 5, 15})})),
        hypotheses{arm.hypothesis(test::unknown(test::spring_law(), 1)),
                   arm.hypothesis(test::unknown(timed_push(), 0))},
        sought(sought_in(arm.evidence, hypotheses)),
        result(arm.nothing_found()),
        stiction(arm.data, sought, result.sticking, 0.01),
        conditions(arm.data, sought, stiction, result),
        system(test::arm_system(arm.evidence)) {}

  /// Structure of some form on a joint.
  void add(GenericStructure::Form form, int joint, double squares, int degrees = 4) {
    const auto own = std::find_if(sought.structures.begin(), sought.structures.end(),
                                  [&](const GenericStructure& structure) {
                                    return structure.form == form && structure.joint == joint;
                                  });
    ASSERT_NE(own, sought.structures.end());
    GenericResult generic;
    generic.structure = static_cast<std::size_t>(own - sought.structures.begin());
    generic.score.delta_chi2 = squares;
    generic.score.degrees = degrees;
    screening.generic.push_back(generic);
  }
  [[nodiscard]] NamedResult push(double begin, double end) {
    hypotheses[1].effect.parameters << 0.5, begin, end;
    return arm.named(sought, 1);
  }

  test::ArmCompetition arm;
  std::vector<Hypothesis> hypotheses;
  Sought sought;
  CompetitionResult result;
  StictionImpulses stiction;
  EffectConditions conditions;
  EvidenceSystem system;
  Screening screening;
};

/// A moment on the first link is none on the second joint, although a force on the second link
/// explains it.
TEST(EffectConditions, AskWhetherAJointCarriesTheTorqueOfAForce) {
  for (const int link : {1, 2}) {
    EffectInstance truth = test::known(test::contact_law(), link - 1, {0, 0, 0.5, 5, 15});
    truth.link = link;
    test::ArmCompetition arm(test::everywhere({truth}));
    EffectInstance second = test::unknown(test::contact_law(), 1);
    second.link = 2;
    std::vector<Hypothesis> hypotheses = {arm.hypothesis(second)};
    hypotheses[0].effect.parameters << 0, 0, 0, 5, 15;
    const Sought sought = sought_in(arm.evidence, hypotheses);
    const CompetitionResult result = arm.nothing_found();
    const StictionImpulses stiction(arm.data, sought, result.sticking, 0.01);
    const EffectConditions conditions(arm.data, sought, stiction, result);
    EvidenceSystem system = test::arm_system(arm.evidence);
    const NamedResult named = arm.named(sought, 0);
    EXPECT_TRUE(conditions.carries_torque(system, named, 0));
    EffectInstance first = test::known(test::contact_law(), 0, {0, 0, 0, 5, 15});
    first.link = 1;
    system.add(system.whitened(effect_columns(arm.evidence, arm.signals, first, {3})));
    EXPECT_EQ(conditions.carries_torque(system, named, 1), link == 2);
  }
}

TEST(EffectConditions, AreNotMetBesideAStrongerFunctionOfTheSameJoint) {
  ConditionScene scene;
  const auto outdone = [&](double explained) {
    return scene.conditions.beside(explained, {1}, scene.system, scene.screening) ==
           EffectConditions::Beside::kOutdone;
  };
  scene.add(GenericStructure::Form::kFunction, 0, 9000);
  EXPECT_FALSE(outdone(100));
  scene.add(GenericStructure::Form::kFunction, 1, 1000);
  EXPECT_TRUE(outdone(100));
  // the function pays for four parameters, some 8 each, and must be better by a tenth and by 9
  EXPECT_TRUE(outdone(860));
  EXPECT_FALSE(outdone(880));
  scene.result.sticking.push_back({1, 300, {0}});
  EXPECT_FALSE(outdone(100));
}

/// A form that its file rules out stands in the way only of what explains less than 0.7 of it.
TEST(EffectConditions, AFormThatIsRuledOutDoesNotBlockWhatExplainsMostOfIt) {
  using Beside = EffectConditions::Beside;
  ConditionScene scene;
  // a spring there is, so that no reversals hide its form
  scene.hypotheses[0].effect.joint = 0;
  NamedResult form = scene.arm.named(scene.sought, 0);
  form.freest.score.delta_chi2 = 1000;
  form.freest.few.clear();
  const auto beside = [&](double explained, int joint) {
    scene.screening.named = {form};
    return scene.conditions.beside(explained, {joint}, scene.system, scene.screening);
  };
  EXPECT_EQ(beside(100, 0), Beside::kNothing);  // it is admissible: another name, no form
  form.freest.admissible = false;
  EXPECT_EQ(beside(100, 0), Beside::kOutdone);
  EXPECT_EQ(beside(690, 0), Beside::kOutdone);
  EXPECT_EQ(beside(700, 0), Beside::kBetterForm);
  EXPECT_EQ(beside(870, 0), Beside::kBetterForm);
  EXPECT_EQ(beside(900, 0), Beside::kNothing);  // hardly better
  EXPECT_EQ(beside(100, 1), Beside::kNothing);  // of another joint
  // a function of the motion has no name that could be ruled out
  scene.add(GenericStructure::Form::kFunction, 0, 1000);
  EXPECT_EQ(beside(800, 0), Beside::kOutdone);
}

TEST(EffectConditions, TakeForAnEventOnlyWhatLastsAndIsStrong) {
  ConditionScene scene;
  ASSERT_TRUE(scene.hypotheses[1].windowed);
  EXPECT_FALSE(scene.conditions.is_no_event(scene.system, scene.push(5, 15)));
  NamedResult weak = scene.push(5, 15);
  weak.slow_noise = weak.best.score.delta_chi2 / 15;  // slow noise alone explains all but 15
  EXPECT_TRUE(scene.conditions.is_no_event(scene.system, weak));
  NamedResult brief = scene.push(5, 15);
  brief.best.effect.parameters[2] = 5 + 2 * scene.arm.evidence.row_time;
  EXPECT_TRUE(scene.conditions.is_no_event(scene.system, brief));
  // what always acts is no event in the first place
  EXPECT_FALSE(scene.conditions.is_no_event(scene.system, scene.arm.named(scene.sought, 0)));
}

}  // namespace
}  // namespace dyngen::runtime
