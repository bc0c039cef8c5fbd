// SPDX-License-Identifier: MIT
#include "runtime/plausibility/derivative_remarks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "runtime/recordings/reader.h"
#include "runtime/recordings/time_base.h"
#include "tests/support/shared_data.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using runtime::Recording;
using runtime::Remark;
using testing::HasSubstr;

constexpr double kStep = 0.001;  // s

/// Two joints that move, with what is true of them: 1 kHz, 8 s, encoders of 2e-5 rad.
Recording moving_arm(double lag = 0) {
  Recording recording;
  recording.file_name = "run.csv";
  recording.run_starts = {0};
  constexpr Index kRows = 8000;
  recording.time.resize(kRows);
  for (auto* matrix : {&recording.q, &recording.dq, &recording.ddq, &recording.tau}) {
    matrix->resize(kRows, 2);
  }
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 1);
  for (Index k = 0; k < kRows; ++k) {
    const double t = kStep * static_cast<double>(k), late = t - lag;
    recording.time[k] = t;
    for (Index j = 0; j < 2; ++j) {
      const double w = j == 0 ? 3.1 : 4.7, v = j == 0 ? 11.0 : 7.9;
      const double q = std::sin(w * t) + 0.2 * std::sin(v * t);
      recording.q(k, j) = 2e-5 * std::round(q / 2e-5);
      recording.dq(k, j) =
          w * std::cos(w * late) + 0.2 * v * std::cos(v * late) + 0.01 * noise(random);
      recording.ddq(k, j) = -w * w * std::sin(w * t) - 0.2 * v * v * std::sin(v * t);
      recording.tau(k, j) = recording.ddq(k, j) + 3 * recording.dq(k, j);
    }
  }
  return recording;
}

std::string words_of(const Recording& recording) {
  std::string words;
  for (const Remark& remark : runtime::derivative_remarks(recording, kStep)) {
    words += remark.text + "\n";
  }
  return words;
}

TEST(DerivativeRemarks, SaysNothingOfWhatIsRight) { EXPECT_EQ(words_of(moving_arm()), ""); }

TEST(DerivativeRemarks, NamesARateThatIsWrongByTwo) {
  Recording recording = moving_arm();
  recording.dq *= 2;
  recording.ddq *= 4;
  const std::string words = words_of(recording);
  EXPECT_THAT(words, HasSubstr("qd of all joints that move is 2 times what q and time say: is a "
                               "sample taken every 0.5 ms, not 1 ms"));
}

TEST(DerivativeRemarks, NamesUnitsSignsAndGears) {
  Recording degrees = moving_arm();
  degrees.dq *= 180 / std::numbers::pi;
  EXPECT_THAT(words_of(degrees), HasSubstr("it looks like deg/s"));
  Recording sign = moving_arm();
  sign.dq.col(1) *= -1;
  sign.ddq.resize(0, 0);
  EXPECT_EQ(words_of(sign), "qd2 is -1 times what q2 and time say: the sign is turned\n");
  Recording motor = moving_arm();
  motor.dq.col(0) *= 100;
  motor.dq.col(1) *= -81;
  motor.ddq.resize(0, 0);
  EXPECT_THAT(words_of(motor),
              HasSubstr("qd1 is 100 times what q1 and time say: unit, sign, gear"));
  EXPECT_THAT(words_of(motor), HasSubstr("qd2 is -81 times"));
}

TEST(DerivativeRemarks, NamesALag) {
  Recording late = moving_arm(0.012);
  late.ddq.resize(0, 0);
  EXPECT_THAT(words_of(late), HasSubstr("qd1 lags behind q1 by 12 ms"));
}

TEST(DerivativeRemarks, NamesSwappedAndDeadColumns) {
  Recording swapped = moving_arm();
  swapped.dq.col(0).swap(swapped.dq.col(1));
  swapped.ddq.resize(0, 0);
  EXPECT_THAT(words_of(swapped), HasSubstr("qd1 does not go with q1 but with q2"));
  Recording dead = moving_arm();
  dead.dq.col(1).setZero();
  EXPECT_THAT(words_of(dead), HasSubstr("qd2 is 0 throughout while q2 moves: it was not measured"));
}

TEST(DerivativeRemarks, JudgesAccelerationsToo) {
  Recording turned = moving_arm();
  turned.ddq.col(0) *= -1;
  EXPECT_THAT(
      words_of(turned),
      testing::ContainsRegex("qdd1 is -(1|0.9.*) times what qd1 and time say: the sign is turned"));
  turned.dq.resize(0, 0);
  EXPECT_THAT(words_of(turned), HasSubstr("qdd1 is -"));
}

TEST(DerivativeRemarks, SaysNothingOfJointsThatStand) {
  Recording recording = moving_arm();
  std::mt19937 random(6);
  std::normal_distribution<double> noise(0, 1);
  for (Index k = 0; k < recording.samples(); ++k) {
    recording.q(k, 1) = 0.3 + 2e-5 * std::round(noise(random));
    recording.dq(k, 1) = 0.01 * noise(random);
    recording.ddq(k, 1) = noise(random);
  }
  EXPECT_EQ(words_of(recording), "");
}

/// What is said of a real recording; nothing where it is not here.
std::optional<std::string> words_of_real(const std::string& name) {
  const auto path = shared_data(name);
  if (!path) return std::nullopt;
  Recording recording = runtime::read_recording(*path);
  const runtime::TimeBase base = runtime::examine_time_base(recording);
  if (!base.uniform) recording = runtime::resample(recording, base.sample_time);
  std::string words;
  for (const Remark& remark : runtime::derivative_remarks(recording, base.sample_time)) {
    words += remark.text + "\n";
  }
  return words;
}

void expect_silence(const std::string& name) {
  const auto words = words_of_real(name);
  if (!words) GTEST_SKIP() << skip_sentence(name);
  EXPECT_EQ(*words, "") << name;
}

TEST(DerivativeRemarks, SaysNothingOfThePendulumOfDfki) {
  for (const char* name : {"dfki/a_0.csv", "dfki/a_2.csv", "dfki/c_1.csv", "dfki/c_3.csv"}) {
    expect_silence(name);
  }
}
TEST(DerivativeRemarks, SaysNothingOfATx40WithoutVelocities) { expect_silence("tx40/tx40.csv"); }
TEST(DerivativeRemarks, SaysNothingOfAKr300) {
  for (const char* name :
       {"kr300/train_1.csv.gz", "kr300/train_2.csv.gz", "kr300/heldout_1.csv.gz"}) {
    expect_silence(name);
  }
}
/// The servo filters the speed that it reports: in three motions the same 21 ms.
TEST(DerivativeRemarks, SaysHowLateAServoReportsItsSpeed) {
  for (const char* name : {"xl330/kp400_sin_sin.csv.gz", "xl330/kp400_up_and_down.csv.gz",
                           "xl330/kp400_sin_time_square.csv.gz"}) {
    const auto words = words_of_real(name);
    if (!words) GTEST_SKIP() << skip_sentence(name);
    EXPECT_THAT(*words, testing::MatchesRegex("qd1 lags behind q1 by 21.[0-9] ms\n")) << name;
  }
}
TEST(DerivativeRemarks, SaysNothingOfTheCompensatedPendulum) {
  for (const char* name : {"dfki_friction/off_1.csv.gz", "dfki_friction/compensated.csv.gz"}) {
    expect_silence(name);
  }
}

}  // namespace
}  // namespace dyngen::test
