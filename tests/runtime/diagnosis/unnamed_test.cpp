// SPDX-License-Identifier: MIT
/// Functions of the motion that no effect is: where they are found, and what they cost a name.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/diagnosis/competition/stiction_impulses.h"
#include "runtime/diagnosis/names/naming.h"
#include "runtime/diagnosis/scans/generic_columns.h"
#include "runtime/diagnosis/scans/screening.h"
#include "runtime/diagnosis/scans/wave_scan.h"
#include "tests/runtime/diagnosis/arm_competition.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = StructureVariable::Kind;
using Form = GenericStructure::Form;

/// a f(own, other) of positions or velocities, one of each joint.
EffectInstance torque_of(const std::string& own, const std::string& other, double size,
                         double (*shape)(double own, double other)) {
  const EffectLaw law = test::algebraic_law(
      "foreign", {own, other}, {{"a", EffectRole::kLinear, -10, 10, 0, 1}},
      [shape](const VectorXd& v, const VectorXd& p) { return p[0] * shape(v[0], v[1]); });
  EffectInstance effect = test::known(law, 1, {size});
  effect.other = 0;
  return effect;
}

EffectInstance wave(double size) {
  return torque_of("q", "q_other", size,
                   [](double own, double other) { return std::sin(2 * other + 3 * own); });
}

EffectInstance product(double size) {
  return torque_of("qd", "qd_other", size,
                   [](double own, double other) { return std::tanh(own * other); });
}

TEST(WaveScan, FindsWhatAWaveTurnsByWithEachPosition) {
  const EffectRecordings data = test::arm_recordings(test::two_recordings({wave(0.05)}, 1));
  const EvidenceSystem system = test::arm_system(data);
  const Waves waves = waves_of(data, 0, 1);
  const WaveScan there = scan_waves(data, system, 1, waves, true);
  const WaveScan other = scan_waves(data, system, 0, waves, true);
  // one of the grid, which is half a wave over the range of a position
  EXPECT_NEAR(there.frequency[0], 2, 0.8);
  EXPECT_NEAR(there.frequency[1], 3, 0.8);
  EXPECT_GT(there.score.delta_chi2, 3 * there.score.surrogates.maxCoeff());
  EXPECT_EQ(there.score.degrees, 2);
  EXPECT_LT(other.score.delta_chi2, 2 * other.score.surrogates.maxCoeff());
}

TEST(WaveScan, HasTheColumnsOfAWaveWhateverItsFrequenciesSigns) {
  const EffectRecordings data = test::arm_recordings(test::two_recordings({}, 1));
  Eigen::Matrix2Xd frequencies(2, 3);
  frequencies << 2, -2, 1.5, 3, -3, -0.5;
  const Eigen::MatrixXd shapes = wave_shapes(data, 0, 1, frequencies);
  Eigen::Index start = 0;
  for (const EffectRun& run : data.runs) {  // one equation a sample
    const Eigen::Index rows = run.rows.Y.rows();
    for (Eigen::Index i = 0; i < frequencies.cols(); ++i) {
      const Eigen::ArrayXd angle = frequencies(0, i) * run.motion.q.col(0).array() +
                                   frequencies(1, i) * run.motion.q.col(1).array();
      EXPECT_LT((shapes.col(2 * i).segment(start, rows).array() - angle.cos()).abs().maxCoeff(),
                1e-12);
      EXPECT_LT((shapes.col(2 * i + 1).segment(start, rows).array() - angle.sin()).abs().maxCoeff(),
                1e-12);
    }
    start += rows;
  }
}

TEST(GenericStructure, ProductOfVelocitiesIsWithinItsColumns) {
  const EffectRecordings data = test::arm_recordings(test::two_recordings({}, 1));
  EffectSignals signals(data);
  const GenericStructure structure{
      1, {{Kind::kVelocity, 0}, {Kind::kVelocity, 1}, {Kind::kPosition, 0}}, Form::kSpeeds};
  EXPECT_EQ(structure.names(), (std::vector<std::string>{"qd1", "qd2", "q1"}));
  const JointColumns columns = generic_columns(data, signals, structure);
  const VectorXd expected =
      values_at_equations(data, signals, {Kind::kVelocity, 0})
          .cwiseProduct(values_at_equations(data, signals, {Kind::kVelocity, 1}));
  // hats add up to 1
  EXPECT_TRUE(columns.parts[0].rowwise().sum().isApprox(expected, 1e-12));
}

TEST(GenericStructure, NamesAVariableOnce) {
  const GenericStructure squared{
      0, {{Kind::kVelocity, 1}, {Kind::kVelocity, 1}, {Kind::kPosition, 0}}, Form::kSpeeds};
  EXPECT_EQ(squared.names(), (std::vector<std::string>{"qd2", "q1"}));
  const GenericStructure friction{1, {{Kind::kVelocity, 1}}, Form::kFriction};
  EXPECT_EQ(friction.names(), std::vector<std::string>{"qd2"});
}

TEST(Diagnosis, AFunctionOfTwoJointsHasNoName) {
  for (const EffectInstance& truth : {wave(0.06), product(0.08)}) {
    const Diagnosis diagnosis =
        diagnose(test::arm_input(test::two_recordings({truth}, 4), {truth},
                                 {test::spring_law(), test::stribeck_law()}),
                 test::every_sample());
    EXPECT_EQ(diagnosis.verdict, Verdict::kUnexplainedStructure) << diagnosis.sentence;
    ASSERT_FALSE(diagnosis.unexplained.empty());
    const Unexplained& unexplained = diagnosis.unexplained.front();
    EXPECT_EQ(unexplained.joint, 1);
    EXPECT_GE(unexplained.variables.size(), 2U) << unexplained.description;
  }
}

TEST(Diagnosis, FloorIsWithoutWhatHasNoName) {
  const EffectInstance truth = wave(0.25);
  const Diagnosis diagnosis =
      diagnose(test::arm_input(test::two_recordings({truth}, 4), {truth}, {test::spring_law()}),
               test::every_sample());
  EXPECT_FALSE(diagnosis.noise.from_periods);
  ASSERT_FALSE(diagnosis.unexplained.empty()) << diagnosis.sentence;
  EXPECT_GT(diagnosis.heldout.after[1], 1.5 * test::kArmNoise);
  // smooth functions have most of the wave, not all
  EXPECT_LT(diagnosis.heldout.floor[1], 1.3 * test::kArmNoise);
  EXPECT_GT(diagnosis.heldout.floor[1], 0.95 * test::kArmNoise);
}

/// Bristles of a friction that falls are that friction where they hardly bend.
TEST(Naming, WhatContainsAFamilyHasToExplainMoreThanIt) {
  EffectLaw bristles = test::stribeck_law();
  bristles.name = "bristles";
  bristles.family = "presliding";
  const EffectInstance truth = test::known(test::stribeck_law(), 1, {3, 0.05});
  const auto names = [&](const EffectLaw& rival) {
    const Diagnosis diagnosis = diagnose(
        test::arm_input(test::two_recordings({truth}, 4), {truth}, {test::stribeck_law(), rival}),
        test::every_sample());
    EXPECT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence;
    return diagnosis.findings.empty() ? std::vector<std::string>{}
                                      : diagnosis.findings.front().aliases;
  };
  EXPECT_EQ(names(bristles).size(), 2U);
  bristles.contains = {"stribeck"};
  EXPECT_EQ(names(bristles), std::vector<std::string>{"stribeck"});
}

TEST(Naming, WhatHasNoNameTakesItsPartOfTheProbability) {
  Naming naming;
  naming.families = {"spring"};
  conclude(naming);
  EXPECT_EQ(naming.probability, 1);
  naming.unnamed_distance = 0;
  conclude(naming);
  EXPECT_NEAR(naming.probability, 0.5, 1e-12);
  naming.unnamed_distance = -50;
  conclude(naming);
  EXPECT_LT(naming.probability, 0.01);
}

/// However much more the form of an effect explains that a condition rules out: it is a doubt.
TEST(Naming, AFormThatIsRuledOutIsADoubtAndNoBetterName) {
  Naming naming;
  naming.families = {"gravity_spring"};
  naming.unnamed_distance = -100;
  conclude(naming);
  EXPECT_LT(naming.probability, 1e-6);
  naming.unnamed_form.ruled_out = test::known(test::spring_law(), 1, {0.4});
  conclude(naming);
  EXPECT_GT(naming.probability, 0.5);
  EXPECT_LT(naming.probability, 0.6);
  EXPECT_EQ(naming.unnamed_distance, -100);  // as it is said
}

/// What a rest does lasts longer than an impulse does: friction goes with the way since then.
TEST(StictionImpulses, AJointRestsWhereFrictionGoesWithTheWaySinceItTurned) {
  const std::vector<Hypothesis> no_names;
  const std::vector<StictionJoint> none;
  const auto sticking = [&](const std::vector<EffectInstance>& effects,
                            const GenericStructure& structure) {
    test::ArmCompetition arm(test::everywhere(effects), 4);
    const Sought sought = sought_in(arm.evidence, no_names);
    const EvidenceSystem system = test::arm_system(arm.evidence);
    ScreeningData screened(arm.evidence);
    const Screening screening = screen(screened, system, sought.scales, test::planar_arm_values(),
                                       no_names, sought.structures, nullptr);
    return StictionImpulses(arm.data, sought, none, 0.01).sticking(system, screening, structure);
  };
  const GenericStructure since{1, {{Kind::kDistance, 1}}, Form::kFriction};
  const GenericStructure by_load{1, {{Kind::kLoad, 1}}, Form::kFriction};
  const EffectInstance slip = test::known(test::slip_law(), 1, {60, 0.05});
  const std::vector<StictionJoint> found = sticking({slip}, since);
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().joint, 1);
  EXPECT_EQ(found.front().recordings.size(), 2U);
  // what is no function of that way, and more than impulses explain, is no rest
  EXPECT_TRUE(sticking({slip}, by_load).empty());
  // where impulses are noise nothing sticks
  EXPECT_TRUE(sticking({}, since).empty());
}

TEST(StictionImpulses, LittleIsNothingOnAJointThatRests) {
  const test::ArmCompetition arm({});
  const std::vector<Hypothesis> no_names;
  const Sought sought = sought_in(arm.evidence, no_names);
  std::vector<StictionJoint> sticking;
  const StictionImpulses stiction(arm.data, sought, sticking, 0.01);
  EXPECT_EQ(stiction.unseen_on({0, 1}), 0);
  sticking = {{1, 500, {}}};
  EXPECT_NEAR(stiction.unseen_on({0}), 1, 1e-12);  // through the arm
  EXPECT_NEAR(stiction.unseen_on({0, 1}), 10, 1e-12);
  EXPECT_TRUE(stiction.sticks(1));
  EXPECT_FALSE(stiction.sticks(0));
}

}  // namespace
}  // namespace dyngen::runtime
