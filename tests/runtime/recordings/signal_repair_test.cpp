// SPDX-License-Identifier: MIT
// Damage that only a whole column shows: repaired to what it was, and nothing else is touched.
#include "runtime/recordings/signal_repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/runtime/recordings/moving_arm.h"
#include "tests/runtime/recordings/recording_texts.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using runtime::Notice;
using runtime::Recording;

/// Arms of different sample times, speeds and encoders.
ArmMotion any_motion(std::mt19937& generator) {
  constexpr double kSampleTimes[] = {0.001, 0.002, 0.004, 0.005, 0.01};
  ArmMotion motion;
  motion.joints = whole_between(1, 6, generator);
  motion.sample_time = kSampleTimes[whole_between(0, 4, generator)];
  motion.speed = between(0.5, 3, generator);
  if (between(0, 1, generator) < 0.5) motion.encoder_step = between(1e-5, 2e-3, generator);
  motion.position_noise = between(0, 1e-4, generator);
  return motion;
}

std::vector<Notice> repair(Recording& recording) {
  std::vector<Notice> notices;
  runtime::repair_signals(recording, notices);
  return notices;
}

std::string texts(const std::vector<Notice>& notices) {
  std::string text;
  for (const Notice& notice : notices) text += notice.text() + "\n";
  return text;
}

/// Into [low, low + a turn).
double wrapped(double angle, double low) {
  return angle - 2 * M_PI * std::floor((angle - low) / (2 * M_PI));
}

/// Whole turns that all rows of `found` are off `truth`; fails if that is no one number.
void expect_turns_off(const Eigen::VectorXd& found, const Eigen::VectorXd& truth) {
  const double turns = std::round((found(0) - truth(0)) / (2 * M_PI));
  EXPECT_LT((found - truth).cwiseAbs().maxCoeff() - 2 * M_PI * std::abs(turns), 1e-9);
}

constexpr unsigned kSeeds = 40;

TEST(SignalRepair, TouchesNothingOfACleanRecording) {
  for (unsigned seed = 0; seed < 3 * kSeeds; ++seed) {
    std::mt19937 generator(seed);
    ArmMotion motion = any_motion(generator);
    if (seed % 3 == 0) motion.encoder_step = 2 * M_PI / 2000;  // coarse
    if (seed % 5 == 0) motion.position_noise = 2e-3;
    const Recording clean = moving_arm(motion, generator);
    Recording recording = clean;
    const auto notices = repair(recording);
    EXPECT_TRUE(notices.empty()) << seed << "\n" << texts(notices);
    EXPECT_TRUE(same(recording, clean)) << seed;
    EXPECT_EQ(recording.lines, clean.lines);
  }
}

TEST(SignalRepair, UnwrapsPositions) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 generator(seed);
    ArmMotion motion = any_motion(generator);
    motion.samples = static_cast<Index>(8 / motion.sample_time);
    Recording truth = moving_arm(motion, generator);
    const Index joint = whole_between(0, motion.joints - 1, generator);
    const double low = seed % 2 == 0 ? -M_PI : 0;
    // through the end of the turn in the middle of the motion
    truth.q.col(joint).array() += low - truth.q.col(joint).mean();
    if (seed % 3 == 0) truth.run_starts = {0, truth.samples() / 2};  // time goes on
    Recording recording = truth;
    for (double& q : recording.q.col(joint)) q = wrapped(q, low);
    const double range = recording.q.col(joint).maxCoeff() - recording.q.col(joint).minCoeff();
    ASSERT_GT(range, 6) << seed;
    const auto notices = repair(recording);
    ASSERT_EQ(notices.size(), 1U) << seed << "\n" << texts(notices);
    EXPECT_NE(notices[0].message.find("q" + std::to_string(joint + 1) + " jumps by a whole turn"),
              std::string::npos);
    EXPECT_GT(notices[0].line, 1U);
    SCOPED_TRACE(seed);
    expect_turns_off(recording.q.col(joint), truth.q.col(joint));
    recording.q.col(joint) = truth.q.col(joint);
    EXPECT_TRUE(same(recording, truth));
  }
}

TEST(SignalRepair, UnwrapsAcrossAGap) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 generator(seed);
    ArmMotion motion;
    motion.speed = 3;
    Recording truth = moving_arm(motion, generator);
    truth.q.col(0).array() += M_PI - truth.q.col(0).mean();
    // the gap holds a passage through the end of the turn
    Index passage = 500;
    while (passage + 500 < truth.samples() &&
           (truth.q(passage, 0) < M_PI) == (truth.q(passage + 1, 0) < M_PI)) {
      ++passage;
    }
    const Index begin = passage - 20, length = 60;
    Recording recording = truth;
    for (const auto part : {&Recording::q, &Recording::tau}) {
      const Index rest = truth.samples() - begin - length;
      (recording.*part).middleRows(begin, rest) = (truth.*part).bottomRows(rest).eval();
      (recording.*part).conservativeResize(begin + rest, Eigen::NoChange);
    }
    const Index rest = truth.samples() - begin - length;
    recording.time.segment(begin, rest) = truth.time.tail(rest).eval();
    recording.time.conservativeResize(begin + rest);
    recording.lines.resize(static_cast<std::size_t>(begin + rest));
    recording.run_starts = {0, begin};
    const Eigen::VectorXd expected = recording.q.col(0);
    for (double& q : recording.q.col(0)) q = wrapped(q, -M_PI);
    repair(recording);
    SCOPED_TRACE(seed);
    expect_turns_off(recording.q.col(0), expected);
  }
}

TEST(SignalRepair, UnwrapsWhereSomebodyInterpolatedAcrossTheJump) {
  for (Index between_ends = 1; between_ends <= 10; ++between_ends) {
    std::mt19937 generator(static_cast<unsigned>(between_ends));
    Recording truth = moving_arm({}, generator);
    truth.q.col(1).array() += M_PI - truth.q.col(1).mean();
    Recording recording = truth;
    for (double& q : recording.q.col(1)) q = wrapped(q, -M_PI);
    Index jump = 30;
    while (std::abs(recording.q(jump + 1, 1) - recording.q(jump, 1)) < 3) ++jump;
    const Index left = jump - between_ends / 2, right = left + between_ends + 1;
    const double from = recording.q(left, 1), to = recording.q(right, 1);
    for (Index k = left + 1; k < right; ++k) {
      recording.q(k, 1) =
          from + (to - from) * static_cast<double>(k - left) / static_cast<double>(right - left);
    }
    const auto notices = repair(recording);
    ASSERT_EQ(notices.size(), 1U) << texts(notices);
    const double turns = std::round((recording.q(0, 1) - truth.q(0, 1)) / (2 * M_PI));
    const Eigen::VectorXd off = recording.q.col(1) - truth.q.col(1);
    EXPECT_LT((off.array() - turns * 2 * M_PI).abs().maxCoeff(), 5e-3) << between_ends;
  }
}

TEST(SignalRepair, DoesNotUnwrapWhatGoesBeyondATurn) {
  std::mt19937 generator(1);
  Recording recording = moving_arm({}, generator);
  recording.q.col(0) *= 5;
  recording.q.col(0).tail(1000).array() += 2 * M_PI;  // of what is no angle within a turn
  const Recording before = recording;
  EXPECT_THROW(repair(recording), runtime::RecordingError);
  EXPECT_TRUE(same(recording, before));
}

TEST(SignalRepair, InterpolatesEncoderGlitches) {
  for (unsigned seed = 0; seed < 3 * kSeeds; ++seed) {
    std::mt19937 generator(seed);
    const ArmMotion motion = any_motion(generator);
    const Recording truth = moving_arm(motion, generator);
    Recording recording = truth;
    const Index joint = whole_between(0, motion.joints - 1, generator);
    const Index number = whole_between(1, 40, generator);
    std::set<Index> rows;
    for (Index i = 0; i < number; ++i) {
      const Index count = whole_between(1, 3, generator);
      const Index row = 12 + i * 70 + whole_between(0, 60, generator);
      const double step = motion.speed * motion.sample_time;
      const double least = std::max({0.02, 4 * step, 12 * motion.encoder_step});
      const double size = between(
          std::max(least, motion.sample_time * 50 * static_cast<double>(count)), 3, generator);
      const double sign = between(-1, 1, generator) < 0 ? -1 : 1;
      for (Index k = row; k < row + count; ++k) {
        recording.q(k, joint) += sign * size;
        rows.insert(k);
      }
    }
    const auto notices = repair(recording);
    ASSERT_EQ(notices.size(), 1U) << seed << "\n" << texts(notices);
    EXPECT_NE(notices[0].message.find("interpolated"), std::string::npos) << texts(notices);
    EXPECT_EQ(notices[0].line, static_cast<std::size_t>(*rows.begin()) + 2) << seed;
    ASSERT_EQ(recording.samples(), truth.samples());
    for (Index k = 0; k < truth.samples(); ++k) {
      const double off = std::abs(recording.q(k, joint) - truth.q(k, joint));
      if (rows.count(k) == 0) {
        EXPECT_EQ(off, 0) << seed << " " << k;
      } else {  // of a parabola over four steps, of noise, and of an encoder's step
        EXPECT_LT(off, 100 * motion.sample_time * motion.sample_time + 8 * motion.position_noise +
                           motion.encoder_step)
            << seed << " " << k;
      }
    }
  }
}

TEST(SignalRepair, LeavesOutGlitchesAtTheEndsOfRuns) {
  for (const Index count : {1, 2, 3}) {
    std::mt19937 generator(static_cast<unsigned>(count));
    const Recording truth = moving_arm({}, generator);
    Recording recording = truth;
    recording.q.col(0).head(count).array() += 0.7;
    recording.q.col(1).tail(count).array() -= 0.4;
    const auto notices = repair(recording);
    ASSERT_EQ(notices.size(), 2U) << texts(notices);
    EXPECT_EQ(notices[0].line, 2U);
    EXPECT_NE(notices[0].message.find("left out"), std::string::npos);
    ASSERT_EQ(recording.samples(), truth.samples() - 2 * count);
    EXPECT_EQ(recording.run_starts, std::vector<Index>{0});
    EXPECT_TRUE(recording.q == truth.q.middleRows(count, recording.samples()));
    EXPECT_EQ(recording.lines.front(), static_cast<std::uint32_t>(count) + 2);
  }
}

TEST(SignalRepair, ASensorThatIsHeldHasNoGlitches) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 generator(seed);
    ArmMotion motion = any_motion(generator);
    Recording recording = moving_arm(motion, generator);
    const Index hold =
        std::max<Index>(2, std::lround(between(0.008, 0.04, generator) / motion.sample_time));
    if (seed % 2 == 0) {  // all the time
      for (Index k = 0; k < recording.samples(); ++k) {
        recording.q(k, 0) = recording.q(k - k % hold, 0);
      }
    } else {  // now and then
      for (Index begin = 20; begin + hold < recording.samples(); begin += 97) {
        recording.q.col(0).segment(begin, hold).setConstant(recording.q(begin, 0));
      }
    }
    const Recording before = recording;
    const auto notices = repair(recording);
    EXPECT_TRUE(notices.empty()) << seed << " " << hold << "\n" << texts(notices);
    EXPECT_TRUE(same(recording, before)) << seed;
  }
}

TEST(SignalRepair, RefusesAColumnFullOfGlitches) {
  std::mt19937 generator(5);
  Recording recording = moving_arm({}, generator);
  for (Index k = 30; k < recording.samples(); k += 15) recording.q(k, 1) += 0.5;
  try {
    repair(recording);
    FAIL() << "nothing was thrown";
  } catch (const runtime::RecordingError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.substr(0, 24), "run.csv:32:1: error: fou") << what;
    EXPECT_NE(what.find("in q2, the first of 198 samples"), std::string::npos) << what;
  }
}

TEST(SignalRepair, InterpolatesGlitchesOfTorque) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 generator(seed);
    const ArmMotion motion = any_motion(generator);
    const Recording truth = moving_arm(motion, generator);
    Recording recording = truth;
    const Index joint = whole_between(0, motion.joints - 1, generator);
    const Index count = whole_between(1, 3, generator), row = whole_between(5, 2900, generator);
    const double value = (seed % 2 == 0 ? 1 : -1) * std::pow(10.0, between(2, 7, generator));
    recording.tau.col(joint).segment(row, count).setConstant(value);
    const auto notices = repair(recording);
    ASSERT_EQ(notices.size(), 1U) << seed << "\n" << texts(notices);
    EXPECT_EQ(notices[0].line, static_cast<std::size_t>(row) + 2);
    EXPECT_NE(notices[0].message.find("tau" + std::to_string(joint + 1) + " is "),
              std::string::npos);
    const Eigen::MatrixXd off = recording.tau - truth.tau;
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 6 * motion.torque_noise + 4.5) << seed;  // friction turns
    EXPECT_EQ((off.array() != 0).count(), count) << seed;
  }
}

TEST(SignalRepair, AStuckColumnBecomesAGap) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 generator(seed);
    ArmMotion motion = any_motion(generator);
    motion.samples = std::max<Index>(motion.samples, static_cast<Index>(4 / motion.sample_time));
    motion.encoder_step = 0;
    motion.position_noise = 1e-5;
    motion.speed = 2;
    const Recording truth = moving_arm(motion, generator);
    Recording recording = truth;
    const Index joint = whole_between(0, motion.joints - 1, generator);
    const Index length =
        std::max<Index>(30, static_cast<Index>(between(0.2, 0.5, generator) / motion.sample_time));
    const bool position = seed % 2 == 0;
    // where the joint goes somewhere
    Index begin = 50;
    while (std::abs(truth.q(begin + length, joint) - truth.q(begin, joint)) < 0.15 &&
           begin + length + 50 < truth.samples()) {
      ++begin;
    }
    auto column = position ? recording.q.col(joint) : recording.tau.col(joint);
    column.segment(begin, length).setConstant(column(begin));
    const auto notices = repair(recording);
    ASSERT_EQ(notices.size(), 1U) << seed << "\n" << texts(notices);
    EXPECT_EQ(notices[0].line, static_cast<std::size_t>(begin) + 3);
    EXPECT_NE(notices[0].message.find("rows are left out, and a new run begins"),
              std::string::npos);
    ASSERT_EQ(recording.samples(), truth.samples() - length + 1) << seed;
    EXPECT_EQ(recording.run_starts, (std::vector<Index>{0, begin + 1}));
    const Index rest = truth.samples() - begin - length;
    EXPECT_TRUE(recording.q.bottomRows(rest) == truth.q.bottomRows(rest));
    EXPECT_TRUE(recording.tau.topRows(begin + 1) == truth.tau.topRows(begin + 1));
    EXPECT_EQ(recording.lines[static_cast<std::size_t>(begin) + 1],
              static_cast<std::uint32_t>(begin + length) + 2);
  }
}

TEST(SignalRepair, APositionThatIsOffForAWhileBecomesAGap) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 generator(seed);
    const ArmMotion motion = any_motion(generator);
    const Recording truth = moving_arm(motion, generator);
    Recording recording = truth;
    const Index joint = whole_between(0, motion.joints - 1, generator);
    const Index length = whole_between(4, 400, generator), row = whole_between(20, 2500, generator);
    const double least = std::max(0.1, 8 * motion.speed * motion.sample_time);
    const double size = (seed % 2 == 0 ? 1 : -1) * between(least, 2, generator);
    recording.q.col(joint).segment(row, length).array() += size;
    const auto notices = repair(recording);
    ASSERT_EQ(notices.size(), 1U) << seed << "\n" << texts(notices);
    EXPECT_EQ(notices[0].line, static_cast<std::size_t>(row) + 2) << texts(notices);
    ASSERT_EQ(recording.samples(), truth.samples() - length) << seed << texts(notices);
    EXPECT_EQ(recording.run_starts, (std::vector<Index>{0, row}));
    EXPECT_TRUE(recording.q.topRows(row) == truth.q.topRows(row));
    const Index rest = truth.samples() - row - length;
    EXPECT_TRUE(recording.q.bottomRows(rest) == truth.q.bottomRows(rest));
  }
}

TEST(SignalRepair, RefusesAPositionThatHasLostItsZero) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 generator(seed);
    const ArmMotion motion = any_motion(generator);
    Recording recording = moving_arm(motion, generator);
    const Index joint = whole_between(0, motion.joints - 1, generator);
    const Index row = whole_between(20, 2900, generator);
    const double least = std::max(0.3, 80 * motion.speed * motion.sample_time);
    const double size = (seed % 2 == 0 ? 1 : -1) * between(least, least + 1, generator);
    recording.q.col(joint).tail(recording.samples() - row).array() += size;
    std::string what = "nothing was thrown";
    try {
      repair(recording);
    } catch (const runtime::RecordingError& error) {
      what = error.what();
    }
    EXPECT_NE(what.find("run.csv:" + std::to_string(row + 2) + ":1: error: found q" +
                        std::to_string(joint + 1)),
              std::string::npos)
        << seed << what;
  }
}

TEST(SignalRepair, MissingRowsWithoutAGapInTimeEndARun) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 generator(seed);
    ArmMotion motion = any_motion(generator);
    motion.speed = 2;
    motion.joints = 6;
    motion.encoder_step = 0;  // a coarse one may stand still just then
    const Recording truth = moving_arm(motion, generator);
    const Index lost = std::lround(0.2 / motion.sample_time),
                row = whole_between(50, 2500, generator);
    const Index rest = truth.samples() - row - lost;
    Recording recording = truth;
    recording.time.conservativeResize(row + rest);
    recording.lines.resize(static_cast<std::size_t>(row + rest));
    for (const auto part : {&Recording::q, &Recording::tau}) {
      (recording.*part).middleRows(row, rest) = (truth.*part).bottomRows(rest).eval();
      (recording.*part).conservativeResize(row + rest, Eigen::NoChange);
    }
    const Recording before = recording;
    const auto notices = repair(recording);
    ASSERT_EQ(notices.size(), 1U) << seed << "\n" << texts(notices);
    EXPECT_NE(notices[0].message.find("as if rows were missing"), std::string::npos)
        << seed << texts(notices);
    ASSERT_EQ(recording.samples(), before.samples());
    EXPECT_EQ(recording.run_starts, (std::vector<Index>{0, row})) << seed;
    EXPECT_TRUE(recording.q == before.q);
  }
}

TEST(SignalRepair, TorqueOfAConstantSpeedIsNotStuck) {
  Recording recording;
  recording.file_name = "run.csv";
  recording.run_starts = {0};
  recording.time = Eigen::VectorXd::LinSpaced(3001, 0, 3);
  recording.q.resize(3001, 1);
  recording.tau.resize(3001, 1);
  double q = 0;
  for (Index k = 0; k < recording.samples(); ++k) {  // there and back, friction alone, no noise
    const double phase = std::fmod(recording.time(k), 1.0);
    const double speed = std::min({1.0, 5 * phase, 5 * (1 - phase)});
    q += 0.001 * (recording.time(k) < 2 ? speed : -speed);
    recording.q(k, 0) = q;
    recording.tau(k, 0) =
        (recording.time(k) < 2 ? 1 : -1) * (2 + speed * speed * speed) + (k > 2900 ? 5 : 0);
  }
  const Recording before = recording;
  const auto notices = repair(recording);
  EXPECT_TRUE(notices.empty()) << texts(notices);
  EXPECT_TRUE(same(recording, before));
}

TEST(SignalRepair, ALimitedOrDeadTorqueIsNotStuck) {
  std::mt19937 generator(3);
  Recording recording = moving_arm({}, generator);
  recording.tau.col(0) = recording.tau.col(0).cwiseMin(6);
  recording.tau.col(1).setZero();
  const Recording before = recording;
  const auto notices = repair(recording);
  EXPECT_TRUE(notices.empty()) << texts(notices);
  EXPECT_TRUE(same(recording, before));
}

/// The joint turns back meanwhile: where the column goes on, little or nothing was missed.
TEST(SignalRepair, APositionThatFreezesAroundAReversalBecomesAGap) {
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    std::mt19937 generator(seed);
    ArmMotion motion;
    motion.sample_time = 0.002;
    motion.samples = 5000;
    Recording recording = moving_arm(motion, generator);
    std::normal_distribution<double> noise(0, 1e-6);
    const double frequency = between(0.3, 1, generator);
    for (Index k = 0; k < recording.samples(); ++k) {
      recording.q(k, 0) =
          0.4 * std::sin(2 * M_PI * frequency * recording.time(k)) + noise(generator);
    }
    const double quarter = 0.25 / frequency, before = between(0.3, 0.9, generator) * quarter,
                 after = between(0.3, 0.9, generator) * quarter;
    const auto row = [&](double t) { return static_cast<Index>(t / motion.sample_time); };
    const Index begin = row(5 * quarter - before), length = row(before + after);
    recording.q.col(0).segment(begin, length).setConstant(recording.q(begin, 0));
    const auto notices = repair(recording);
    ASSERT_EQ(notices.size(), 1U) << seed << "\n" << texts(notices);
    EXPECT_NE(notices[0].message.find("q1 freezes while the joint moves"), std::string::npos);
    EXPECT_EQ(recording.run_starts, (std::vector<Index>{0, begin + 1})) << seed;
    EXPECT_EQ(recording.samples(), 5000 - length + 1);
  }
}

/// Commanded positions go from one constant speed to rest within a sample.
TEST(SignalRepair, AMotionWithPausesIsNotStuck) {
  std::mt19937 generator(5);
  ArmMotion motion;
  motion.sample_time = 0.002;
  motion.samples = 5000;
  Recording recording = moving_arm(motion, generator);
  for (Index k = 0; k < recording.samples(); ++k) {
    const double t = recording.time(k), turn = std::floor(t / 2), within = t - 2 * turn;
    recording.q(k, 0) = 0.3 * (turn + std::clamp(within - 0.5, 0.0, 1.0));
  }
  const Recording before = recording;
  const auto notices = repair(recording);
  EXPECT_TRUE(notices.empty()) << texts(notices);
  EXPECT_TRUE(same(recording, before));
}

TEST(SignalRepair, AJointThatStopsIsNotStuck) {
  std::mt19937 generator(4);
  Recording recording = moving_arm({}, generator);
  for (Index k = 0; k < recording.samples(); ++k) {  // friction holds it, then lets it go
    const double t = recording.time(k);
    const double along = std::max(0.0, std::sin(3 * t));
    recording.q(k, 0) = 0.4 * along * along;
  }
  const Recording before = recording;
  const auto notices = repair(recording);
  EXPECT_TRUE(notices.empty()) << texts(notices);
  EXPECT_TRUE(same(recording, before));
}

}  // namespace
}  // namespace dyngen::test
