// SPDX-License-Identifier: MIT
/// What held-out recordings say of functions of the motion without a name.
#include "runtime/diagnosis/competition/nameless_proof.h"

#include <gtest/gtest.h>

#include <cmath>

#include "runtime/diagnosis/competition/half_band_test.h"
#include "runtime/diagnosis/scans/generic_columns.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;
using Kind = StructureVariable::Kind;
using Form = GenericStructure::Form;

/// Joint 2's torque, as joint 1 moves.
EffectInstance drag_of_the_other(double size) {
  const EffectLaw law = test::algebraic_law(
      "foreign", {"qd_other"}, {{"a", EffectRole::kLinear, -10, 10, 0, 1}},
      [](const VectorXd& v, const VectorXd& p) { return p[0] * std::tanh(v[0] / 0.3); });
  EffectInstance effect = test::known(law, 1, {size});
  effect.other = 0;
  return effect;
}

EffectRecordings heldout_recordings(const std::vector<EffectInstance>& effects, unsigned seed) {
  return test::arm_recordings(test::measured({test::sines(40, 0.01, 4.3, 0.9)},
                                             test::planar_arm_values(), effects, test::kArmNoise, 0,
                                             seed));
}

/// What the fitted recordings have of a function of the other joint's velocity, against those held
/// out.
struct Trial {
  Nameless nameless;
  HeldoutProof proof;
};

Trial trial(double fitted, double heldout, unsigned seed) {
  const EffectRecordings train =
      test::arm_recordings(test::two_recordings({drag_of_the_other(fitted)}, seed));
  EffectSignals signals(train);
  const EvidenceSystem system = test::arm_system(train);
  Trial trial;
  trial.nameless.structure = {1, {{Kind::kVelocity, 0}}, Form::kFunction};
  const JointColumns columns =
      system.whitened(generic_columns(train, signals, trial.nameless.structure));
  trial.nameless.score = score_of(system.products(columns, false), false);
  CompetitionResult result;
  result.fit.point.beta = test::planar_arm_values();
  const EffectRecordings other = heldout_recordings({drag_of_the_other(heldout)}, seed + 1000);
  HalfBandTest half_band(train);
  const CompetitionData data{train, signals, train, half_band, other};
  trial.proof = nameless_proof(data, {}, result, test::arm_noise(), trial.nameless, {});
  return trial;
}

TEST(NamelessProof, HeldOutRecordingsThatHaveItHelp) {
  constexpr double kSize = 0.03;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Trial there = trial(kSize, kSize, seed);
    ASSERT_GT(there.nameless.score.delta_chi2, 30) << seed;
    EXPECT_TRUE(there.proof.helps()) << seed;
    EXPECT_TRUE(there.proof.agrees()) << seed;
    const Trial gone = trial(kSize, 0, seed);
    EXPECT_FALSE(gone.proof.helps()) << seed;
    // it is added where nothing is
    EXPECT_NEAR(gone.proof.before - gone.proof.after, -gone.proof.change,
                3.5 * 2 * std::sqrt(gone.proof.change))
        << seed;
  }
}

/// What is sketched as a function of one variable comes out smaller elsewhere. Beyond doubt it may
/// be said all the same, unless held-out recordings do not have it at all.
TEST(NamelessProof, WhatIsBeyondDoubtMayBeLessThanWasSaid) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const HeldoutProof less = trial(0.12, 0.08, seed).proof;
    EXPECT_TRUE(less.helps()) << seed;
    EXPECT_FALSE(less.agrees()) << seed;
    EXPECT_TRUE(is_supported(less, true)) << seed;
    EXPECT_TRUE(is_supported(less, false)) << seed;
    const HeldoutProof gone = trial(0.12, 0, seed).proof;
    EXPECT_FALSE(is_supported(gone, true)) << seed;
    EXPECT_FALSE(is_supported(gone, false)) << seed;
  }
}

TEST(NamelessProof, WhatNoiseGaveSeldomHelps) {
  constexpr unsigned kTrials = 60;
  int helped = 0;
  for (unsigned seed = 1; seed <= kTrials; ++seed) helped += trial(0, 0, seed).proof.helps();
  // the change has some 8 squares, and comes out at -8 +- 6: 5 % are above 2
  EXPECT_LE(helped, 9);
}

TEST(NamelessProof, IsOfWhatBelongsToTheMotion) {
  Nameless nameless;
  const auto provable = [&](GenericStructure structure) {
    nameless.structure = std::move(structure);
    return is_provable(nameless);
  };
  EXPECT_TRUE(provable({0, {{Kind::kVelocity, 1}, {Kind::kPosition, 0}}, Form::kFunction}));
  EXPECT_TRUE(provable({0, {{Kind::kLoad, 0}}, Form::kFriction}));
  EXPECT_TRUE(provable({0, {{Kind::kPosition, 0}, {Kind::kPosition, 1}}, Form::kWave}));
  EXPECT_FALSE(provable({0, {{Kind::kTime, -1}}, Form::kFunction}));
  EXPECT_FALSE(provable({0, {}, Form::kLine}));
  EXPECT_FALSE(provable({0, {}, Form::kRepeats}));
  EXPECT_FALSE(provable({0, {}, Form::kImpulses}));
}

TEST(GenericStructure, HasTheSameFunctionsOnOtherRecordings) {
  const EffectRecordings train = test::arm_recordings(test::two_recordings({}, 1));
  const EffectRecordings other = heldout_recordings({}, 2);
  EffectSignals signals(train), others(other);
  const GenericStructure structure{
      1, {{Kind::kVelocity, 0}, {Kind::kVelocity, 1}, {Kind::kPosition, 0}}, Form::kSpeeds};
  const StructureKnots knots = structure_knots(train, signals, structure);
  ASSERT_EQ(knots.size(), 1U);
  EXPECT_EQ(generic_columns(train, signals, structure, knots).parts[0],
            generic_columns(train, signals, structure).parts[0]);
  // hats of q1, times both velocities: alone where q1 is at a knot
  const auto columns = generic_columns(other, others, structure, knots).parts[0];
  const VectorXd q = values_at_equations(other, others, {Kind::kPosition, 0});
  const VectorXd product =
      values_at_equations(other, others, {Kind::kVelocity, 0})
          .cwiseProduct(values_at_equations(other, others, {Kind::kVelocity, 1}));
  Eigen::Index middle = 0;
  (q.array() - knots[0][1]).abs().minCoeff(&middle);
  const double reach = knots[0][2] - knots[0][0];
  EXPECT_NEAR(columns(middle, 1) / product[middle], 1,
              4 * std::abs(q[middle] - knots[0][1]) / reach + 1e-12);
}

}  // namespace
}  // namespace dyngen::runtime
