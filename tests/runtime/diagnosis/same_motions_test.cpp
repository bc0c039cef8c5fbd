// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/same_motions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "runtime/diagnosis/answer/condition_lines.h"
#include "runtime/diagnosis/equation_sets/raw_residual.h"
#include "runtime/diagnosis/equation_sets/repeated_motion.h"
#include "runtime/evidence/torque_noise_model.h"
#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kOfSample = 0.01;  // s

/// Rows of a motion, as a recording that began later.
Motion part(const Motion& motion, Index first, Index rows) {
  Motion result = motion;
  result.time = motion.time.segment(first, rows).array() - motion.time[first];
  for (MatrixXd Motion::*signal : {&Motion::q, &Motion::dq, &Motion::ddq}) {
    result.*signal = (motion.*signal).middleRows(first, rows);
  }
  return result;
}

/// Three recordings of one motion, begun at other times, and one of another motion between them.
std::vector<Motion> three_and_another() {
  const Motion whole = test::sines(32, kOfSample, 0.3);
  return {part(whole, 20, 2900), part(whole, 0, 3000), test::sines(30, kOfSample, 2.3),
          part(whole, 55, 3000)};
}

std::vector<const Motion*> pointers(const std::vector<Motion>& motions) {
  std::vector<const Motion*> all;
  for (const Motion& motion : motions) all.push_back(&motion);
  return all;
}

TEST(SameMotions, AreFoundWithTheirLags) {
  const std::vector<Motion> motions = three_and_another();
  const auto earlier = earlier_motions(pointers(motions));
  EXPECT_FALSE(earlier[0]);
  ASSERT_TRUE(earlier[1]);
  EXPECT_EQ(earlier[1]->run, 0U);
  EXPECT_NEAR(earlier[1]->lag, -0.2, 1e-4);
  EXPECT_FALSE(earlier[2]);
  ASSERT_TRUE(earlier[3]);
  EXPECT_EQ(earlier[3]->run, 1U);
  EXPECT_NEAR(earlier[3]->lag, 0.55, 1e-4);
}

TEST(SameMotions, ThatRepeatInThemselvesAreOfOneRecording) {
  std::vector<Motion> motions = three_and_another();
  motions[1].period = 5;
  const auto earlier = earlier_motions(pointers(motions));
  EXPECT_FALSE(earlier[1]);
  ASSERT_TRUE(earlier[3]);
  EXPECT_EQ(earlier[3]->run, 0U);
}

TEST(SameMotions, AreTheMeanOfTheOthers) {
  std::vector<Motion> motions = three_and_another();
  const std::vector<Motion> exact = motions;
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (Motion& motion : motions) {
    for (double& q : motion.q.reshaped()) q += 1e-3 * normal(random);
  }
  const auto means = of_same_motions(pointers(motions));
  EXPECT_FALSE(means[2]);
  for (const std::size_t i : {0U, 1U, 3U}) {
    ASSERT_TRUE(means[i]);
    const auto middle = [](const MatrixXd& rows) { return rows.middleRows(100, 2700); };
    const MatrixXd own = middle(motions[i].q) - middle(exact[i].q);
    const MatrixXd others = middle(means[i]->q) - middle(exact[i].q);
    const double size = std::sqrt(others.squaredNorm() / static_cast<double>(others.size()));
    EXPECT_NEAR(size, 1e-3 / std::sqrt(2), 4e-5);
    EXPECT_LT(std::abs(own.cwiseProduct(others).mean()), 5e-8);  // nothing in common
    EXPECT_EQ(means[i]->tau.size(), motions[i].tau.size());
  }
  // two are too few
  const std::vector<Motion> two(motions.begin(), motions.begin() + 2);
  EXPECT_FALSE(of_same_motions(pointers(two))[0]);
}

TEST(SameMotions, GiveTheNoiseWithoutWhatIsLeftOut) {
  const std::vector<EffectInstance> effects = {test::known(test::spring_law(), 0, {3}),
                                               test::known(test::coulomb_asymmetry_law(), 1, {2})};
  EffectRecordings data = test::arm_recordings(test::measured(
      three_and_another(), test::planar_arm_values(), effects, test::kArmNoise, 0.5, 7));
  RunResiduals residuals;
  for (const EffectRun& run : data.runs) {
    residuals.push_back(residual(run.rows, test::planar_arm_values()));
  }
  const std::vector<double> repeats = repeats_of(data);
  const TorqueNoiseModel blind = torque_noise_model(data, residuals, repeats, false);
  EXPECT_FALSE(blind.from_periods);
  find_same_motions(data);
  const TorqueNoiseModel noise = torque_noise_model(data, residuals, repeats, false);
  EXPECT_TRUE(noise.from_periods);
  EXPECT_TRUE(noise.of_recordings);
  for (std::size_t j = 0; j < 2; ++j) {
    EXPECT_NEAR(noise.joints[j].deviation(), test::kArmNoise, 0.05 * test::kArmNoise);
    EXPECT_GT(blind.joints[j].deviation(), 3 * noise.joints[j].deviation());
    // known by two differences of four recordings, of which noise with memory is a third
    EXPECT_GT(noise.worth[static_cast<Index>(j)], 1500);
    EXPECT_LT(noise.worth[static_cast<Index>(j)], 2500);
  }
  const RunResiduals raw = raw_residuals(data, at_rest(data, test::planar_arm_values(), {}));
  const VectorXd floor = raw_floor(data, raw, repeats);
  for (const double joint : floor) EXPECT_NEAR(joint, test::kArmNoise, 0.05 * test::kArmNoise);
}

TEST(SameMotions, AreSaidInTheCondition) {
  DiagnosisInput input;
  input.train = test::measured(three_and_another(), test::planar_arm_values(), {}, 0.1, 0, 1);
  for (std::size_t i = 0; i < input.train.size(); ++i) {
    input.train[i].name = "run" + std::to_string(i + 1) + ".csv";
  }
  EffectRecordings train = test::arm_recordings(input.train);
  find_same_motions(train);
  const std::vector<ConditionLine> lines = condition_lines(input, {}, &train);
  EXPECT_EQ(lines[0].sentences.back(), "the motion does not repeat");
  EXPECT_EQ(lines[1].sentences.back(), "its motion is that of run1.csv");
  EXPECT_EQ(lines[3].sentences.back(), "its motion is that of run2.csv");
}

TEST(SameMotions, AreInstrumentsOfOneAnother) {
  const std::vector<MotionSource> sources =
      test::measured(three_and_another(), test::planar_arm_values(), {}, test::kArmNoise, 0, 7);
  const std::vector<TwoMotions> two = two_motions(sources);
  ASSERT_EQ(two.size(), 4U);
  const auto first_q = [](const MotionSource& source) {
    double q = 0;
    source.pieces([&](const StreamPiece& piece) { q = piece.motion.q(500, 0); });
    return q;
  };
  for (std::size_t i = 0; i < two.size(); ++i) {
    EXPECT_NEAR(first_q(two[i].own), first_q(two[i].other), 1e-6);  // exact positions
    EXPECT_EQ(first_q(two[i].own) == first_q(two[i].other), i == 2);
  }
}

}  // namespace
}  // namespace dyngen::runtime
