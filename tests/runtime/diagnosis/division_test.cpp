// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/equation_sets/division.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/diagnosis/diagnosis.h"
#include "runtime/evidence/joint_columns.h"
#include "tests/runtime/effects/effect_arm.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// 10 s of two joints; from `stop` on the second stands.
MotionSource moving_until(double stop) {
  Recording recording;
  constexpr Index kSamples = 5000;
  recording.time = VectorXd::LinSpaced(kSamples, 0, 10 - 2e-3);
  recording.q.resize(kSamples, 2);
  recording.tau = Eigen::MatrixXd::Ones(kSamples, 2);
  for (Index k = 0; k < kSamples; ++k) {
    const double t = recording.time[k], until = std::min(t, stop);
    recording.q(k, 0) = std::sin(5 * t);
    recording.q(k, 1) = std::cos(4 * until);
  }
  recording.run_starts = {0};
  MotionOptions options;
  options.average_periods = false;
  options.state.cutoff_hz = 10;
  return motion_of(std::move(recording), options);
}

std::pair<double, double> span(const MotionSource& source) {
  double first = 1e9, last = -1e9;
  source.pieces([&](const StreamPiece& piece) {
    first = std::min(first, piece.motion.time[0]);
    last = std::max(last, piece.motion.time[piece.motion.samples() - 1]);
  });
  return {first, last};
}

TEST(Division, HoldsOutTheLastFifthInWhichAllJointsMove) {
  const Division whole = divided({moving_until(20)});
  ASSERT_EQ(whole.train.size(), 1U);
  EXPECT_GT(span(whole.heldout.front()).first, 7.5);

  const Division stopped = divided({moving_until(6.2)});
  ASSERT_EQ(stopped.train.size(), 2U);
  const auto [first, last] = span(stopped.heldout.front());
  EXPECT_NEAR(first, 4, 0.3);
  EXPECT_NEAR(last, 6, 0.3);
  // nothing is in both
  EXPECT_LT(span(stopped.train[0]).second, first);
  EXPECT_GT(span(stopped.train[1]).first, last);
}

TEST(Division, KnowsOfWhichRecordingEachPartIs) {
  const Division both = divided({moving_until(6.2), moving_until(20)});
  EXPECT_EQ(both.origins, (std::vector<std::size_t>{0, 0, 1}));
  EXPECT_EQ(both.origin_of(2), 1U);
  const Division whole{both.train, both.heldout};
  EXPECT_EQ(whole.origin_of(2), 2U);
}

/// Two parts of it are fitted, and it is one recording all the same.
TEST(Division, ADiagnosisTellsTheConditionOfAWholeRecording) {
  DiagnosisInput input;
  input.model = test::planar_arm();
  input.robot = test::planar_arm_tangents();
  input.train = {moving_until(6.2)};
  const Diagnosis diagnosis = diagnose(input, {});
  ASSERT_EQ(diagnosis.condition.size(), 1U);
  EXPECT_EQ(std::count(diagnosis.condition[0].sentences.begin(),
                       diagnosis.condition[0].sentences.end(), "the motion does not repeat"),
            1);
}

TEST(RowPlan, GivesNoMoreEquationsThanAskedFor) {
  MotionSource source =
      test::measured({test::sines(10, 0.002)}, test::planar_arm_values(), {}, 0, 0, 1).front();
  source.cutoff.hz = 20;
  RowOptions rows;
  rows.band = 1;
  EXPECT_EQ(plan_rows(source, rows).decimation, 12);  // 0.5 / (20 Hz 2 ms) = 12.5
  rows.row_time = 0.05;
  EXPECT_EQ(plan_rows(source, rows).decimation, 25);
  rows.multiple = 4;
  EXPECT_EQ(plan_rows(source, rows).decimation, 28);
  rows.row_time = 0.001;
  EXPECT_EQ(plan_rows(source, rows).decimation, 12);
  rows.decimation = 3;
  EXPECT_EQ(plan_rows(source, rows).decimation, 3);
}

TEST(Thinned, ColumnsAreThoseOfAllSamples) {
  // equations of 20 samples: columns of a spring
  const EffectInstance spring = test::known(test::spring_law(), 1, {0.2});
  for (const int averages : {0, 4}) {
    RowOptions rows;
    rows.decimation = 20;
    rows.filter = {.pass = 0.5, .averages = averages};
    const EffectRecordings data = effect_recordings(
        test::planar_arm(), test::planar_arm_tangents(),
        test::measured({test::sines(20, 0.002)}, test::planar_arm_values(), {spring}, 0, 0, 1),
        rows, {true, true});
    const EffectRecordings few = thinned(data), some = thinned(data, 0.0041);
    EXPECT_EQ(few.runs.front().decimator.factor, kThinnedSamples);
    EXPECT_EQ(some.runs.front().decimator.factor, 10);
    EffectSignals all_signals(data), few_signals(few), some_signals(some);
    const Eigen::MatrixXd all = effect_columns(data, all_signals, spring, {0}).parts[0];
    const double size = all.cwiseAbs().maxCoeff();
    const double reach = data.runs.front().motion.sample_time *
                         static_cast<double>(data.runs.front().decimator.taps.size());
    for (const auto& [thin, signals] :
         {std::pair(&few, &few_signals), std::pair(&some, &some_signals)}) {
      const EffectRun& run = thin->runs.front();
      const Eigen::MatrixXd part = effect_columns(*thin, *signals, spring, {0}).parts[0];
      ASSERT_EQ(part.rows(), all.rows());
      EXPECT_LT((part - all).cwiseAbs().maxCoeff(), 1e-3 * size);
      EXPECT_NEAR(run.motion.sample_time * static_cast<double>(run.decimator.taps.size()), reach,
                  3 * run.motion.sample_time);
    }
  }
}

}  // namespace
}  // namespace dyngen::runtime
