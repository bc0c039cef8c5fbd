// SPDX-License-Identifier: MIT
#include "runtime/identification/standing_joints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/competition/search.h"
#include "runtime/diagnosis/diagnosis.h"
#include "runtime/diagnosis/equation_sets/sufficiency.h"
#include "runtime/estimation/covariance.h"
#include "runtime/estimation/unseen.h"
#include "runtime/evidence/torque_noise_model.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kPosture = 0.4;  // rad, of the joint that stands

/// One joint of the planar arm moves. The other stands, and gives way by a little.
Motion sweep(int joint, double seconds, double phase, double posture = kPosture) {
  Motion motion = test::sines(seconds, 0.01, phase);
  const int other = 1 - joint;
  const Eigen::ArrayXd angle = 5 * motion.time.array();
  motion.q.col(other) = posture + 1e-4 * angle.sin();
  motion.dq.col(other) = 5e-4 * angle.cos();
  motion.ddq.col(other) = -2.5e-3 * angle.sin();
  return motion;
}

std::vector<MotionSource> recorded(const std::vector<Motion>& motions,
                                   const std::vector<EffectInstance>& effects, unsigned seed = 1,
                                   double noise = test::kArmNoise) {
  return test::measured(motions, test::planar_arm_values(), effects, noise, 0, seed);
}

const std::vector<bool> kRevolute = {true, true};

std::vector<EffectLaw> laws() {
  return {test::load_friction_law(), test::spring_law(), test::ripple_law()};
}

/// Sweeps of some joints, two recordings of each, and one more of each that is held out.
DiagnosisInput sweeps_of(const std::vector<int>& joints, const std::vector<EffectInstance>& effects,
                         unsigned seed = 1) {
  std::vector<Motion> train, heldout;
  for (const int joint : joints) {
    train.push_back(sweep(joint, 25, 0.3 + joint));
    train.push_back(sweep(joint, 25, 2.3 + joint));
    heldout.push_back(sweep(joint, 20, 4.3 + joint));
  }
  DiagnosisInput input = test::arm_input(recorded(train, effects, seed), effects, laws());
  input.heldout = recorded(heldout, effects, seed + 100);
  return input;
}

TEST(StandingJoints, AreThoseThatHardlyMoveInARecording) {
  const auto sources = recorded({sweep(0, 5, 0.3), sweep(1, 5, 0.3), test::sines(5, 0.01)}, {});
  EXPECT_EQ(standing_joints(sources, kRevolute, sources),
            (std::vector<StandingJoints>{{false, true}, {true, false}, {false, false}}));
  // of one recording: beside the joint that moves there
  EXPECT_EQ(standing_joints({sources[0]}, kRevolute, {sources[0]}),
            (std::vector<StandingJoints>{{false, true}}));
  // a joint that slides is not measured by one that turns
  EXPECT_EQ(standing_joints({sources[0]}, {true, false}, {sources[0]}),
            (std::vector<StandingJoints>{{false, false}}));
  // what is held out stands beside what is fitted
  EXPECT_EQ(standing_joints({sources[2]}, kRevolute, {sources[1]}),
            (std::vector<StandingJoints>{{true, false}}));
}

TEST(StandingJoints, AreStillAtTheirMeanPosition) {
  const MotionSource source = recorded({sweep(1, 5, 0.3)}, {}).front();
  const MotionSource still = with_joints_still(source, {true, false});
  EXPECT_THAT(still.condition.messages,
              testing::Contains("joint 1 stands throughout: taken as still at its mean position, "
                                "no equations"));
  EXPECT_EQ(still.fastest[0], 0);
  EXPECT_EQ(still.fastest[1], source.fastest[1]);
  Index samples = 0;
  source.pieces([&](const StreamPiece& before) {
    still.pieces([&](const StreamPiece& piece) {
      samples = piece.motion.samples();
      EXPECT_NEAR(piece.motion.q(0, 0), before.motion.q.col(0).mean(), 1e-12);
      EXPECT_EQ(piece.motion.q.col(0).minCoeff(), piece.motion.q.col(0).maxCoeff());
      EXPECT_EQ(piece.motion.dq.col(0).norm(), 0);
      EXPECT_EQ(piece.motion.ddq.col(0).norm(), 0);
      EXPECT_EQ(piece.motion.q.col(1), before.motion.q.col(1));
      EXPECT_EQ(piece.motion.tau, before.motion.tau);
    });
  });
  EXPECT_EQ(samples, 500);
  EXPECT_THROW((void)with_joints_still(source, {true}), std::invalid_argument);
}

TEST(StandingJoints, AreNotJudged) {
  DiagnosisInput input = sweeps_of({0}, {});
  hold_standing_joints(kRevolute, input.train, {&input.heldout});
  const Search search(input, 1);
  ASSERT_EQ(search.unjudged().size(), 1U);
  EXPECT_EQ(search.unjudged()[0].joint, 1);
  EXPECT_EQ(search.unjudged()[0].equations, 0);
  EXPECT_EQ(search.unjudged()[0].why, "joint 2 stands in all fitted recordings");
  EXPECT_TRUE(search.sets().train.is_masked(1));
  EXPECT_FALSE(search.sets().proof.is_masked(0));
  EXPECT_EQ(counted_part(search.sets().heldout)[1], 0);
  EXPECT_EQ(why_too_few(search.unjudged(), 2), "");
}

TEST(StandingJoints, HaveTheirEquationsFromRecordingsInWhichTheyMove) {
  DiagnosisInput input = sweeps_of({0, 1}, {});
  hold_standing_joints(kRevolute, input.train, {&input.heldout});
  const Search search(input, 1);
  EXPECT_TRUE(search.unjudged().empty());
  const VectorXd counted = counted_part(search.sets().train);
  EXPECT_NEAR(counted[0], 0.5, 0.02);
  EXPECT_NEAR(counted[1], 0.5, 0.02);
}

// two equations for each parameter that the posture shows, six of the arm's ten on joint 1
TEST(StandingJoints, AskForEquationsByTheParametersThatTheyShow) {
  const auto unjudged = [](double seconds) {
    DiagnosisInput input = sweeps_of({0}, {});
    input.train = recorded({sweep(0, seconds, 0.3)}, {});
    hold_standing_joints(kRevolute, input.train, {&input.heldout});
    return Search(input, 1).unjudged();
  };
  EXPECT_EQ(unjudged(0.46).size(), 1U);
  const std::vector<UnjudgedJoint> all = unjudged(0.38);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].needed, 30 + 2 * 6);
  EXPECT_THAT(why_too_few(all, 2),
              testing::AllOf(testing::HasSubstr("Every joint has too few equations"),
                             testing::HasSubstr("joint 1 has 38 fitted equations"),
                             testing::HasSubstr("joint 2 stands in all fitted recordings"),
                             testing::HasSubstr("Record motions in which at least one joint")));
}

TEST(StandingJoints, HaveNoNoiseThatLimitsOthers) {
  DiagnosisInput input = sweeps_of({0}, {});
  hold_standing_joints(kRevolute, input.train, {&input.heldout});
  const Search search(input, 1);
  const EffectRecordings& train = search.sets().train;
  const EffectFit fit = fit_effects(train, {});
  const TorqueNoiseModel noise =
      torque_noise_model(train, residuals_of(train, fit.point), repeats_of(train), true);
  EXPECT_NEAR(noise.joints[0].deviation(), test::kArmNoise, 0.01);
  EXPECT_GT(noise.worth[0], 1000);
  EXPECT_EQ(noise.worth[1], 0);
}

// joint 2 stands: joint 1 shows inertia, two moments of gravity, friction and offset. The sums in
// them are named; without standing joints held still, noise would give every parameter a number.
TEST(StandingJoints, HideCombinationsThatAFitNames) {
  std::vector<MotionSource> sources = recorded({sweep(0, 25, 0.3)}, {});
  const LinearModel arm = test::planar_arm();
  const auto fitted = [&] {
    return weighted_least_squares(
        factor_of(rows_of(arm, sources.front(), {1}), arm.columns, arm.size()));
  };
  EXPECT_GT(fitted().rank, 6);
  hold_standing_joints(kRevolute, sources, {});
  const Estimate estimate = fitted();
  EXPECT_EQ(estimate.rank, 6);
  EXPECT_EQ(estimate.status, EstimateStatus::kRankDeficient);
  MotionExtent extent;
  sources.front().pieces([&](const StreamPiece& piece) {
    extent.add(piece.motion.q, piece.motion.dq, piece.motion.ddq);
  });
  const std::vector<UnseenCombination> unseen = name_unseen(estimate, arm, extent);
  EXPECT_EQ(unseen.size(), static_cast<std::size_t>(arm.size() - 6));
  for (const UnseenCombination& own : unseen) EXPECT_FALSE(own.advice.empty()) << own.text;
}

TEST(Diagnosis, OfASweptJointFindsItsEffect) {
  const EffectInstance spring = test::known(test::spring_law(), 0, {0.5});
  const Diagnosis diagnosis = diagnose(sweeps_of({0}, {spring}), test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence;
  ASSERT_EQ(diagnosis.findings.size(), 1U);
  EXPECT_EQ(diagnosis.findings[0].effect.law.name, "gravity_spring");
  EXPECT_EQ(diagnosis.findings[0].effect.joint, 0);
  EXPECT_NEAR(diagnosis.findings[0].effect.parameters[0], 0.5, 0.1);
  ASSERT_EQ(diagnosis.not_judged.size(), 1U);
  EXPECT_EQ(diagnosis.not_judged[0].joint, 1);
  EXPECT_THAT(diagnosis.sentence, testing::HasSubstr("Joint 2 stands: it is not judged."));
  EXPECT_TRUE(std::isnan(diagnosis.heldout.after[1]));
  EXPECT_LT(diagnosis.heldout.after[0], diagnosis.heldout.before[0]);
}

TEST(Diagnosis, OfASweptJointThatLacksNothingIsClean) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Diagnosis diagnosis = diagnose(sweeps_of({1}, {}, seed), test::every_sample());
    EXPECT_EQ(diagnosis.verdict, Verdict::kClean) << diagnosis.sentence;
    EXPECT_FALSE(diagnosis.certificate.empty());
    for (const CertificateLine& line : diagnosis.certificate) EXPECT_EQ(line.effect.joint, 1);
    // what the posture hides has no number: only sums with it are seen
    Index open = 0;
    for (const BaseShift& shift : diagnosis.base_parameters) open += std::isnan(shift.stddev);
    EXPECT_GT(open, 3);
    EXPECT_LT(open, 13);
  }
}

TEST(Diagnosis, OfSweepsOfEveryJointJudgesAll) {
  const EffectInstance ripple = test::known(test::ripple_law(), 1, {0.2, 0.1, 21});
  const Diagnosis diagnosis = diagnose(sweeps_of({0, 1}, {ripple}), test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kExplained) << diagnosis.sentence;
  ASSERT_EQ(diagnosis.findings.size(), 1U);
  EXPECT_EQ(diagnosis.findings[0].effect.law.name, "torque_ripple");
  EXPECT_EQ(diagnosis.findings[0].effect.joint, 1);
  EXPECT_TRUE(diagnosis.not_judged.empty());
}

// sweeps in one posture say nothing of the torque of both joints in motion
TEST(Diagnosis, OfSweepsDoesNotProveAMotionOfAllJoints) {
  DiagnosisInput input = sweeps_of({0, 1}, {});
  input.heldout = recorded({test::sines(20, 0.01, 4.3)}, {}, 100);
  const Diagnosis diagnosis = diagnose(input, test::every_sample());
  EXPECT_EQ(diagnosis.verdict, Verdict::kInsufficientData) << diagnosis.sentence;
  EXPECT_TRUE(diagnosis.findings.empty());
}

// equations of other joints are no samples of a joint's noise
TEST(NoiseFactor, IsOfTheEquationsThatAJointHas) {
  std::vector<MotionSource> sources = recorded({sweep(0, 25, 0.3), sweep(1, 25, 0.3)}, {});
  hold_standing_joints(kRevolute, sources, {});
  const LinearModel arm = test::planar_arm();
  std::vector<RowSource> rows;
  for (const MotionSource& source : sources) rows.push_back(rows_of(arm, source, {1}));
  const NoiseFactor noise = noise_factor(joined(rows), arm.columns, test::planar_arm_values());
  const TorqueFactor factor = factor_of(joined(rows), arm.columns, arm.size());
  for (Index j = 0; j < 2; ++j) {
    const auto& own = factor.joints[static_cast<std::size_t>(j)];
    EXPECT_NEAR(std::sqrt(noise.power[j] / own.rows), test::kArmNoise, 0.004);
    // F'F = sigma^2 Y'Y of white noise
    const Eigen::MatrixXd& F = noise.F[static_cast<std::size_t>(j)];
    const double expected = test::kArmNoise * own.R.leftCols(F.cols()).norm();
    EXPECT_NEAR(F.norm() / expected, 1, 0.05);
  }
}

}  // namespace
}  // namespace dyngen::runtime
