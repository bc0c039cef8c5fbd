// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/answer/condition_lines.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/runtime/diagnosis/arm_diagnosis.h"

namespace dyngen::runtime {
namespace {

using testing::Contains;
using testing::HasSubstr;

DiagnosisInput two_and_one() {
  // three periods of 4 s, and sines that have none in common
  const double speed = 5 * std::acos(-1.0);
  DiagnosisInput input;
  input.train = test::measured({test::sines(12, 0.01, 0.3, speed), test::sines(12, 0.01, 2.3)},
                               test::planar_arm_values(), {}, 0.1, 0, 1);
  input.heldout = test::measured({test::sines(12, 0.01)}, test::planar_arm_values(), {}, 0.1, 0, 2);
  input.train[0].name = "first.csv";
  input.train[0].condition.sample_time = 0.01;
  input.train[0].condition.jitter = 0.02;
  input.train[0].condition.position_step = {1e-5, 0};
  input.train[0].condition.repairs = {{"first.csv", 17, 5, "a value twice"}};
  input.train[1].condition.messages = {"torque of joint 2 stands at its limit"};
  input.heldout[0].name = "last.csv";
  input.train[1].condition.position_step = {2e-5, 2e-5};
  input.heldout[0].condition.position_step = {0, 0};
  return input;
}

TEST(ConditionLines, SayWhatWasFoundAndRepaired) {
  const DiagnosisInput input = two_and_one();
  const std::vector<ConditionLine> lines = condition_lines(input, {}, nullptr);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].recording, "first.csv");
  EXPECT_THAT(lines[0].sentences, Contains("a sample every 10 ms (100 Hz), jitter 2 %"));
  EXPECT_THAT(lines[0].sentences, Contains("encoder steps of joint 1: 1e-05"));
  EXPECT_THAT(lines[0].sentences, Contains(HasSubstr("first.csv:17:5: warning: a value twice")));
  EXPECT_THAT(lines[1].sentences, Contains("encoder steps of joints 1, 2: 2e-05"));
  EXPECT_THAT(lines[1].sentences, Contains("torque of joint 2 stands at its limit"));
  EXPECT_EQ(lines[2].recording, "last.csv");
  EXPECT_THAT(lines[2].sentences, Contains("no steps of an encoder are seen in the positions"));
}

TEST(ConditionLines, SayWhetherTheMotionRepeats) {
  const DiagnosisInput input = two_and_one();
  const EffectRecordings train = test::arm_recordings(input.train);
  const std::vector<double> repeats = repeats_of(train);
  ASSERT_GT(repeats[0], 0);
  ASSERT_EQ(repeats[1], 0);
  const std::vector<ConditionLine> lines = condition_lines(input, {}, &train);
  const auto& run = train.runs[0];
  const double row_time = run.motion.sample_time * static_cast<double>(run.decimator.factor);
  EXPECT_THAT(lines[0].sentences,
              Contains(HasSubstr(fmt::format("repeats every {:.5g} s", repeats[0] * row_time))));
  EXPECT_THAT(lines[1].sentences, Contains("the motion does not repeat"));
  EXPECT_EQ(lines[2].sentences.size(), condition_lines(input, {}, nullptr)[2].sentences.size());
}

/// Where a fifth of one recording is held out two parts of it are fitted.
TEST(ConditionLines, AreOfRecordingsNotOfTheirParts) {
  DiagnosisInput input = two_and_one();
  input.heldout.clear();
  Division parts;
  for (const double from : {0.0, 0.6}) {
    parts.train.push_back(part_of(input.train[1], from, from + 0.4));
    parts.origins.push_back(1);
  }
  const EffectRecordings train = test::arm_recordings(parts.train);
  const std::vector<ConditionLine> lines = condition_lines(input, parts, &train);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0].sentences, testing::Not(Contains(HasSubstr("repeat"))));
  EXPECT_EQ(std::count(lines[1].sentences.begin(), lines[1].sentences.end(),
                       "the motion does not repeat"),
            1);
}

}  // namespace
}  // namespace dyngen::runtime
