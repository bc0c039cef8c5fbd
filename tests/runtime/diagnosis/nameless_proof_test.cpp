// SPDX-License-Identifier: MIT
/// What held-out recordings say of functions of the motion without a name.
#include "runtime/diagnosis/competition/nameless_proof.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

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
  const ProofData data{train, signals, other};
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

constexpr double kHertz = 7.3;

/// A sinusoid on joint 2 that goes on by itself.
EffectInstance line_of(double size, double phase) {
  const EffectLaw law =
      test::algebraic_law("foreign", {"t"}, {{"a", EffectRole::kLinear, -10, 10, 0, 1}},
                          [phase](const VectorXd& v, const VectorXd& p) {
                            return p[0] * std::sin(2 * std::numbers::pi * kHertz * v[0] + phase);
                          });
  return test::known(law, 1, {size});
}

/// Fitted recordings with such a sinusoid, and held-out ones with another size and phase of it.
HeldoutProof proof_of_line(double fitted, double heldout, unsigned seed) {
  const EffectRecordings train =
      test::arm_recordings(test::two_recordings({line_of(fitted, 0.7 * seed)}, seed));
  const EffectRecordings other = heldout_recordings({line_of(heldout, 1.9 * seed)}, seed + 1000);
  EffectSignals signals(train);
  Nameless nameless;
  nameless.structure = {1, {}, Form::kLine};
  nameless.structure.frequency[0] = kHertz;
  const EvidenceSystem system = test::arm_system(train);
  nameless.score = score_of(
      system.products(system.whitened(generic_columns(train, signals, nameless.structure)), false),
      false);
  CompetitionResult result;
  result.fit.point.beta = test::planar_arm_values();
  const ProofData data{train, signals, other};
  return nameless_proof(data, {}, result, test::arm_noise(), nameless, {});
}

/// A sinusoid that goes on by itself does so in held-out recordings, in any phase.
TEST(NamelessProof, ALineIsInHeldOutRecordingsToo) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const HeldoutProof there = proof_of_line(0.02, 0.02, seed);
    EXPECT_TRUE(there.informs()) << seed;
    EXPECT_TRUE(is_supported(there, false)) << seed;
    EXPECT_TRUE(is_supported(there, true)) << seed;
  }
  int helped = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const HeldoutProof gone = proof_of_line(0.02, 0, seed);
    EXPECT_TRUE(gone.informs()) << seed;
    helped += gone.helps();
  }
  EXPECT_LE(helped, 3);  // 5 % of noise: more than 6 of chi-square with 2 degrees
}

TEST(NamelessProof, AnEffectGainsWhatItExplainsOfHeldOutRecordings) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const EffectInstance effect = drag_of_the_other(0.06);
    const EffectRecordings train = test::arm_recordings(test::two_recordings({effect}, seed));
    EffectSignals signals(train);
    CompetitionResult result;
    result.fit.point.beta = test::planar_arm_values();
    const auto gain_of = [&](double there) {
      const EffectRecordings other = heldout_recordings({drag_of_the_other(there)}, seed + 1000);
      const HeldoutProof proof =
          effect_proof({train, signals, other}, {}, result, test::arm_noise(), effect, {});
      return std::pair(proof.before - proof.after, proof.change);
    };
    const auto [there, change] = gain_of(0.06);
    EXPECT_NEAR(there, change, 4 * 2 * std::sqrt(change)) << seed;
    EXPECT_NEAR(gain_of(0).first, -change, 4 * 2 * std::sqrt(change)) << seed;
  }
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
  EXPECT_TRUE(provable({0, {}, Form::kLine}));
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
