// SPDX-License-Identifier: MIT
// That a habit records what its name says, and nothing that its machine does not do.
#include "tests/blind/cases/habit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/blind/cases/asked.h"
#include "tests/blind/cases/crowd.h"

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const std::string kFolder = DYNGEN_SOURCE_DIR "/tests/blind/arms";

Draft drafted(const std::string& habit, const std::string& arm = "planar2", std::uint64_t seed = 7,
              bool noisy = false) {
  CaseOptions options;
  options.habit = habit;
  options.arm = arm;
  options.seed = seed;
  options.noisy = noisy;
  return *draw_case(options, kFolder);
}

/// The first seconds of a fitted recording.
Recording short_recording(const Draft& draft, std::size_t place, double seconds) {
  Ride ride = ride_of(draft, place);
  ride.duration = std::min(ride.duration, seconds);
  Recording recording = record(draft, {}, {}, ride);
  recording.torque_noise = MatrixXd::Zero(recording.log.q.rows(), recording.log.q.cols());
  return recording;
}

/// Rms of what a refit leaves over the rms of the torque.
double left_of(const Draft& draft, const Recording& recording, const MatrixXd& torque) {
  MatrixXd columns = base_columns(draft.machine, recording.log), tau = torque_rows(torque);
  for (MatrixXd* rows : {&columns, &tau}) leave_out_rest(recording.log, *rows);
  const std::vector<VectorXd> left = Refit({columns}).residual({tau});
  return std::sqrt(squares(left) / tau.squaredNorm());
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const Habit& habit : habits()) names.push_back(habit.name);
  return names;
}

class EveryHabit : public testing::TestWithParam<std::string> {};

TEST_P(EveryHabit, KeepsToTheLimitsOfEveryArm) {
  for (const char* arm : {"planar2", "twisted4", "puma560", "ur10e", "panda"}) {
    const Draft draft = drafted(GetParam(), arm);
    for (const Motion& motion : draft.motions) {
      for (double t = 0; t < motion.duration; t += 0.02) {
        const Wanted here = motion.at(t);
        EXPECT_GE((here.q - draft.arm.q_min).minCoeff(), 0) << arm << " at " << t;
        EXPECT_GE((draft.arm.q_max - here.q).minCoeff(), 0) << arm << " at " << t;
        EXPECT_GE((draft.arm.v_max - here.dq.cwiseAbs()).minCoeff(), 0) << arm << " at " << t;
        EXPECT_GE((draft.arm.a_max - here.ddq.cwiseAbs()).minCoeff(), 0) << arm << " at " << t;
      }
    }
  }
}

TEST_P(EveryHabit, OfANullWithoutNoiseLeavesNothing) {
  const Draft draft = drafted(GetParam());
  const Recording recording = short_recording(draft, 0, 8);
  EXPECT_LT(left_of(draft, recording, known_torque(recording)), 1e-9);
  const Columns columns = columns_of(recording, draft.logger);
  EXPECT_EQ(columns.q.rows(), columns.tau.rows());
  EXPECT_TRUE(columns.q.allFinite() && columns.tau.allFinite());
}

INSTANTIATE_TEST_SUITE_P(Habits, EveryHabit, testing::ValuesIn(all_names()),
                         [](const auto& each) { return each.param; });

TEST(Habit, OfPeriodsHasThemInTheSameLength) {
  const double length = 5 * drafted("laboratory").motions[0].duration;
  for (const auto& [name, periods] : {std::pair{"one_period", 1},
                                      {"two_periods", 2},
                                      {"three_periods", 3},
                                      {"ten_periods", 10}}) {
    const Draft draft = drafted(name);
    const Ride ride = ride_of(draft, 0);
    EXPECT_NEAR(ride.duration, periods * ride.motion.duration, 1e-9) << name;
    EXPECT_NEAR(ride.duration, length, 0.1 * periods + 1e-9) << name;
  }
  const Recording twice = short_recording(drafted("two_periods"), 0, 100);
  const Index half = twice.log.q.rows() / 2;
  EXPECT_NEAR((twice.log.q.topRows(half) - twice.log.q.bottomRows(half)).norm(), 0,
              1e-3 * twice.log.q.norm());
}

TEST(Habit, OfFilesHasSoMany) {
  EXPECT_EQ(drafted("one_file").training, 1U);
  EXPECT_EQ(drafted("many_files").training, 8U);
  EXPECT_LT(ride_of(drafted("many_files"), 0).duration, 9);
  EXPECT_EQ(drafted("laboratory").motions.size(), 5U);
}

TEST(Habit, OfSweepsMovesOneJointAtATime) {
  const Draft draft = drafted("sweeps", "twisted4");
  std::set<Index> moved;
  for (double t = 0; t < draft.motions[0].duration; t += 0.01) {
    const VectorXd dq = draft.motions[0].at(t).dq;
    EXPECT_LE((dq.array() != 0).count(), 1) << t;
    for (Index j = 0; j < dq.size(); ++j) {
      if (dq[j] != 0) moved.insert(j);
    }
  }
  EXPECT_EQ(moved.size(), 4U);
}

TEST(Habit, OfSpeedStepsRunsAtConstantSpeeds) {
  const Draft draft = drafted("speed_steps");
  int constant = 0, all = 0;
  std::set<double> speeds;
  for (double t = 0; t < draft.motions[0].duration; t += 0.01) {
    const Wanted here = draft.motions[0].at(t);
    ++all;
    if (here.dq[0] == 0 || here.ddq[0] != 0) continue;
    ++constant;
    speeds.insert(std::round(1e6 * here.dq[0]));
  }
  EXPECT_GT(constant, all / 2);
  EXPECT_GE(speeds.size(), 4U);
}

TEST(Habit, OfTeachingIsSlowAndPauses) {
  const Draft draft = drafted("teaching");
  int still = 0, all = 0;
  for (double t = 0; t < draft.motions[0].duration; t += 0.01) {
    const VectorXd dq = draft.motions[0].at(t).dq;
    EXPECT_LE(dq.cwiseAbs().cwiseQuotient(draft.arm.v_max).maxCoeff(), 0.2 + 1e-9);
    ++all;
    still += dq.isZero(0);
  }
  EXPECT_GT(still, all / 20);
}

TEST(Habit, OfRampedMotionsBeginsAndEndsAtRest) {
  const Motion motion = drafted("ramped").motions[0];
  for (const double t : {0.0, 0.9, motion.duration - 0.9}) EXPECT_TRUE(motion.at(t).dq.isZero(0));
  EXPECT_FALSE(motion.at(motion.duration / 2).dq.isZero(1e-3));
}

TEST(Habit, OfChirpsChangesItsFrequency) {
  const Motion motion = drafted("chirps").motions[0];
  const auto turns = [&](double from, double to) {
    int count = 0;
    double before = 0;
    for (double t = from * motion.duration; t < to * motion.duration; t += 0.01) {
      const double dq = motion.at(t).dq[0];
      count += dq * before < 0;
      before = dq;
    }
    return count;
  };
  const int first = turns(0.05, 0.35), last = turns(0.65, 0.95);
  EXPECT_GT(std::max(first, last), 2 * std::min(first, last));
}

TEST(Habit, OfTeleoperationDoesNotRepeat) {
  const Motion motion = drafted("teleoperation").motions[0];
  EXPECT_FALSE(motion.repeats);
  EXPECT_GT((motion.at(3).q - motion.at(13).q).norm() + (motion.at(4).q - motion.at(14).q).norm(),
            0.1);
}

TEST(Habit, OfJitterStampsLateAndInMilliseconds) {
  const Draft draft = drafted("jittered");
  const Recording recording = short_recording(draft, 0, 4);
  const VectorXd time = columns_of(recording, draft.logger).time;
  double most = 0;
  for (Index k = 0; k < time.size(); ++k) {
    const double late = (time[k] - static_cast<double>(k) / draft.rate) * draft.rate;
    most = std::max(most, late);
    EXPECT_GE(late, -0.5e-3 * draft.rate - 1e-9);
    EXPECT_LE(late, 0.3 + 0.5e-3 * draft.rate + 1e-9);
    EXPECT_NEAR(time[k] * 1e3, std::round(time[k] * 1e3), 1e-6);
    if (k > 0) EXPECT_GT(time[k], time[k - 1]);
  }
  EXPECT_GT(most, 0.05);
}

TEST(Habit, OfLateColumnsShiftsPositions) {
  const Draft draft = drafted("late_columns");
  const Recording recording = short_recording(draft, 0, 3);
  const Columns columns = columns_of(recording, draft.logger);
  const Index late = draft.logger.late;
  EXPECT_TRUE(late >= 1 && late <= 3) << late;
  const MatrixXd q = recording.log.q + recording.encoder_error;
  EXPECT_EQ(columns.q.row(10), q.row(10));
  EXPECT_EQ(columns.tau.row(10), recording.log.recorded.row(10 + late));
}

TEST(Habit, OfCurrentHasAGainForEachJoint) {
  const Draft draft = drafted("current", "panda", 7, true);
  ASSERT_EQ(draft.logger.gain.size(), 7);
  EXPECT_EQ(draft.noise.colour, Colour::kPink);
  const double spread = std::sqrt((draft.logger.gain.array() - 1).square().mean());
  EXPECT_GT(spread, 0.015);
  EXPECT_LT(spread, 0.12);
}

TEST(Habit, OfInstrumentsHasThem) {
  EXPECT_LE(drafted("coarse_encoder", "planar2", 7, true).noise.bits, 14);
  EXPECT_GE(drafted("coarse_encoder", "planar2", 7, true).noise.bits, 12);
  EXPECT_LE(drafted("slow_logger").rate, 100);
  EXPECT_GE(drafted("fast_logger").rate, 1000);
  EXPECT_GE(ride_of(drafted("slow_logger"), 0).duration, 59);
}

TEST(Habit, OfADisturbedLoopActsWithoutBeingRecorded) {
  const Draft draft = drafted("loop_disturbance");
  const Recording recording = short_recording(draft, 0, 8);
  ASSERT_EQ(recording.disturbance.rows(), recording.log.q.rows());
  const double rms = std::sqrt(recording.disturbance.col(0).squaredNorm() /
                               static_cast<double>(recording.log.q.rows()));
  EXPECT_GT(rms, 0.2 * draft.disturbance[0]);
  EXPECT_LT(rms, 3 * draft.disturbance[0]);
  EXPECT_GT(left_of(draft, recording, recording.log.recorded), 1e-3);
}

TEST(Habit, WithoutPeriodsMayHaveADisturbedLoopOrCoarseEncoders) {
  for (const std::string path : {"points", "teleoperation"}) {
    const Draft loop = drafted("loop_" + path),
                coarse = drafted("coarse_" + path, "planar2", 7, true);
    EXPECT_FALSE(loop.motions.front().repeats) << path;
    EXPECT_GE(loop.disturbance_share, 0.01) << path;
    EXPECT_LE(loop.disturbance_share, 0.05) << path;
    EXPECT_FALSE(coarse.motions.front().repeats) << path;
    EXPECT_EQ(coarse.disturbance.size(), 0) << path;
    EXPECT_LE(coarse.noise.bits, 14) << path;
  }
}

TEST(Habit, OfOwnCompensationLeavesFrictionThatIsNotRecorded) {
  const Draft draft = drafted("own_compensation");
  ASSERT_EQ(draft.compensation.size(), 2);
  const VectorXd wrong = (draft.compensation.array() - 1).abs();
  EXPECT_TRUE(wrong.minCoeff() >= 0.1 && wrong.maxCoeff() <= 0.3) << wrong;
  const Recording recording = short_recording(draft, 0, 8);
  EXPECT_GT(left_of(draft, recording, recording.log.recorded), 1e-3);
}

TEST(Habit, KeepsTheMachineOfASeed) {
  const Draft here = drafted("laboratory"), there = drafted("chirps");
  EXPECT_EQ(here.machine.coulomb, there.machine.coulomb);
  EXPECT_EQ(here.noise.memory, there.noise.memory);
  EXPECT_THROW(habit_of("none such"), std::invalid_argument);
}

TEST(Crowd, HasFrictionOnEveryJointAndNothingTwice) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CaseOptions options;
    options.kind = "crowd";
    options.seed = seed;
    options.arm = seed % 2 == 0 ? "planar2" : "puma560";
    const Draft draft = *draw_case(options, kFolder);
    std::set<std::pair<std::string, int>> pairs;
    std::set<int> rubbed;
    for (const Truth& truth : draft.truths) {
      EXPECT_TRUE(pairs.emplace(truth.family, truth.joint).second) << truth.family;
      if (truth.family == "presliding" || truth.family == "stribeck") rubbed.insert(truth.joint);
    }
    EXPECT_EQ(static_cast<Index>(rubbed.size()), draft.arm.joints());
    EXPECT_GE(draft.truths.size(), 4U);
    EXPECT_LE(draft.truths.size(), 12U);
    ASSERT_EQ(draft.wanted.size(), draft.truths.size());
    for (const double wanted : draft.wanted) EXPECT_TRUE(wanted >= 100 && wanted <= 5000);
  }
}

// Effects that did not reach their strength are in no entry.
TEST(Crowd, IsRedrawnFromItsEntry) {
  CaseOptions options;
  options.kind = "crowd";
  options.arm = "planar2";
  options.seed = 4;
  const Draft draft = *draw_case(options, kFolder);
  nlohmann::json entry = {{"kind", "crowd"},
                          {"wanted_lambda", 1},
                          {"seed", 4},
                          {"arm", "planar2"},
                          {"rate", draft.rate},
                          {"noise", "white"},
                          {"truths", nlohmann::json::array()}};
  for (std::size_t i = 1; i < draft.truths.size(); ++i) {
    entry["truths"].push_back({{"family", draft.truths[i].family},
                               {"form", draft.truths[i].form},
                               {"joint", draft.truths[i].joint},
                               {"size", 0.1}});
  }
  const Redrawn redrawn = redraw(entry, kFolder);
  EXPECT_EQ(redrawn.draft.truths.size(), draft.truths.size() - 1);
  EXPECT_EQ(redrawn.draft.truths.front().family, draft.truths[1].family);
}

}  // namespace
}  // namespace blind
