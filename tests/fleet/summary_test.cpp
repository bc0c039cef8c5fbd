// SPDX-License-Identifier: MIT
#include "runtime/identification/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "runtime/estimation/least_squares.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/fleet/fleet_recordings.h"

namespace dyngen::runtime {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Each merge is an orthogonal transformation: errors of some 1e-16 of the largest entry, times the
// root of the number of columns.
constexpr double kRounding = 1e-12;

class Fleet : public testing::Test {
 protected:
  static constexpr std::size_t kRecordings = 6;

  static void SetUpTestSuite() {
    robot_ = new DescribedRobot(describe_robot(DYNGEN_SOURCE_DIR "/robots/puma560_3dof.robot",
                                               OpenParameters::kAbsentRows));
    for (unsigned i = 0; i < kRecordings; ++i) {
      const auto recording = test::fleet_recording(robot_->linear, i + 1, {.seconds = 8});
      sources_.push_back(motion_of(recording, {}));
      parts_.push_back(summarise(robot_->linear, sources_.back(), {}));
    }
  }
  static void TearDownTestSuite() {
    delete robot_;
    sources_.clear();
    parts_.clear();
  }

  static RecordingSummary nothing() {
    return empty_summary(robot_->linear.columns, robot_->linear.size());
  }
  static RecordingSummary merged(const std::vector<std::size_t>& places) {
    RecordingSummary sum = nothing();
    for (const std::size_t i : places) merge(sum, parts_[i]);
    return sum;
  }

  static DescribedRobot* robot_;
  static std::vector<MotionSource> sources_;
  static std::vector<RecordingSummary> parts_;
};
DescribedRobot* Fleet::robot_ = nullptr;
std::vector<MotionSource> Fleet::sources_;
std::vector<RecordingSummary> Fleet::parts_;

double difference(const TorqueFactor& a, const TorqueFactor& b) {
  double worst = 0;
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    const double scale = std::max(a.joints[j].R.cwiseAbs().maxCoeff(), 1e-300);
    worst = std::max(worst, (a.joints[j].R - b.joints[j].R).cwiseAbs().maxCoeff() / scale);
  }
  return worst;
}

double difference(const Estimate& a, const Estimate& b) {
  return std::max((a.beta - b.beta).norm() / a.beta.norm(),
                  (a.covariance - b.covariance).norm() / a.covariance.norm());
}

void expect_same(const RecordingSummary& a, const RecordingSummary& b) {
  for (std::size_t j = 0; j < a.equations.joints.size(); ++j) {
    EXPECT_EQ(a.equations.joints[j].rows, b.equations.joints[j].rows);
    EXPECT_EQ(a.regressor_noise.joints[j].rows, b.regressor_noise.joints[j].rows);
  }
  EXPECT_LT(difference(a.equations, b.equations), kRounding);
  EXPECT_LT(difference(a.regressor_noise, b.regressor_noise), kRounding);
  for (std::size_t j = 0; j < a.noise.F.size(); ++j) {
    // a rotation of F is no difference
    const MatrixXd square = a.noise.F[j].transpose() * a.noise.F[j];
    const MatrixXd other = b.noise.F[j].transpose() * b.noise.F[j];
    EXPECT_LT((square - other).norm(), kRounding * square.norm());
  }
  EXPECT_LT((a.noise.power - b.noise.power).norm(), kRounding * a.noise.power.norm());
  EXPECT_LT(difference(weighted_least_squares(a.equations), weighted_least_squares(b.equations)),
            kRounding);
  EXPECT_EQ(a.recordings, b.recordings);
  EXPECT_EQ(a.extent.samples, b.extent.samples);
  EXPECT_EQ(a.extent.lowest, b.extent.lowest);
  EXPECT_EQ(a.extent.highest, b.extent.highest);
  EXPECT_EQ(a.lowest_cutoff, b.lowest_cutoff);
  EXPECT_EQ(a.highest_cutoff, b.highest_cutoff);
  EXPECT_NEAR(a.row_time, b.row_time, kRounding * a.row_time);
  EXPECT_NEAR(a.seconds(), b.seconds(), kRounding * a.seconds());
}

TEST_F(Fleet, SummariesMergeToTheEquationsOfAllSamplesAtOnce) {
  std::vector<RowSource> rows;
  for (const MotionSource& source : sources_) {
    rows.push_back(rows_of(robot_->linear, source, {}));
  }
  const TorqueFactor at_once =
      factor_of(joined(rows), robot_->linear.columns, robot_->linear.size());
  const RecordingSummary sum = merged({0, 1, 2, 3, 4, 5});
  EXPECT_LT(difference(at_once, sum.equations), kRounding);
  EXPECT_LT(difference(weighted_least_squares(at_once), weighted_least_squares(sum.equations)),
            kRounding);
}

TEST_F(Fleet, TheOrderOfMergingDoesNotMatter) {
  const RecordingSummary in_order = merged({0, 1, 2, 3, 4, 5});
  std::vector<std::size_t> places(kRecordings);
  std::iota(places.begin(), places.end(), std::size_t{0});
  for (const auto& order :
       {std::vector<std::size_t>{5, 4, 3, 2, 1, 0}, std::vector<std::size_t>{3, 0, 5, 1, 4, 2},
        std::vector<std::size_t>{2, 5, 0, 4, 3, 1}}) {
    expect_same(in_order, merged(order));
  }
}

TEST_F(Fleet, TheGroupingOfMergesDoesNotMatter) {
  const RecordingSummary in_order = merged({0, 1, 2, 3, 4, 5});
  RecordingSummary halves = merged({0, 1, 2});
  merge(halves, merged({3, 4, 5}));
  expect_same(in_order, halves);
  RecordingSummary tree = merged({4, 1}), right = merged({0, 5});
  merge(right, merged({2}));
  merge(tree, right);
  merge(tree, merged({3}));
  expect_same(in_order, tree);
}

TEST_F(Fleet, TenThousandMergesOfTheSameGiveAHundredTimesTheFactor) {
  // One after the other: the worst order. Each adds a rounding of its own, in any direction.
  TorqueFactor sum = parts_[0].equations;
  for (int i = 1; i < 10000; ++i) merge(sum, parts_[0].equations);
  TorqueFactor hundredfold = parts_[0].equations;
  for (JointFactor& joint : hundredfold.joints) {
    joint.R *= 100;
    joint.rows *= 10000;
  }
  const Estimate a = weighted_least_squares(sum), b = weighted_least_squares(hundredfold);
  const double factor = difference(sum, hundredfold);
  const double beta = (a.beta - b.beta).norm() / b.beta.norm();
  RecordProperty("factor", std::to_string(1e12 * factor) + "e-12");
  RecordProperty("beta", std::to_string(1e12 * beta) + "e-12");
  EXPECT_LT(factor, kRounding);
  EXPECT_LT(beta, kRounding);
}

TEST_F(Fleet, SecondsAreThoseOfAllRecordings) {
  double seconds = 0;
  for (const RecordingSummary& part : parts_) {
    // a joint that stands still for a moment has fewer equations, the recording lasts as long
    EXPECT_NEAR(part.seconds(), part.extent.samples / 500, 0.05);
    seconds += part.seconds();
  }
  EXPECT_NEAR(merged({0, 1, 2, 3, 4, 5}).seconds(), seconds, kRounding * seconds);
}

TEST_F(Fleet, ASummaryOfNothingChangesNothing) {
  RecordingSummary sum = merged({0, 1});
  merge(sum, nothing());
  expect_same(merged({0, 1}), sum);
  RecordingSummary late = nothing();
  merge(late, merged({0, 1}));
  expect_same(merged({0, 1}), late);
}

TEST_F(Fleet, AnotherRecordingIsADifference) {  // the checker above can fail
  EXPECT_GT(difference(merged({0, 1, 2}).equations, merged({0, 1, 3}).equations), 1e-3);
  EXPECT_GT(difference(weighted_least_squares(merged({0, 1, 2}).equations),
                       weighted_least_squares(merged({0, 1, 3}).equations)),
            1e-6);
}

TEST_F(Fleet, RobotsOfDifferentNamesStayApart) {
  RobotSummaries a = empty_summaries(robot_->linear), b = a, c = a;
  a.robots.emplace("left", parts_[0]);
  b.robots.emplace("right", parts_[1]);
  c.robots.emplace("left", parts_[2]);
  merge(a, b);
  merge(a, c);
  ASSERT_EQ(a.robots.size(), 2U);
  EXPECT_EQ(a.robots.at("left").recordings, 2);
  EXPECT_EQ(a.robots.at("right").recordings, 1);
  expect_same(merged({0, 2}), a.robots.at("left"));
  EXPECT_EQ(difference(parts_[1].equations, a.robots.at("right").equations), 0);
  expect_same(merged({0, 2, 1}), pooled(a));
}

TEST_F(Fleet, AnotherModelIsRefusedWithTheDifference) {
  const DescribedRobot other =
      describe_robot(DYNGEN_SOURCE_DIR "/robots/planar2r.robot", OpenParameters::kAbsentRows);
  RobotSummaries all = empty_summaries(robot_->linear);
  try {
    merge(all, empty_summaries(other.linear));
    FAIL() << "it was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("joint 1 is waist in one"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace dyngen::runtime
