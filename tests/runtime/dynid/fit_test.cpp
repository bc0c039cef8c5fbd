// SPDX-License-Identifier: MIT
#include "runtime/identification/fit.h"

#include <gtest/gtest.h>

#include "runtime/identification/hierarchy.h"
#include "runtime/identification/motion_rows.h"
#include "runtime/identification/motion_source.h"
#include "runtime/identification/simulated_motion.h"
#include "runtime/identification/summary.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

DescribedRobot puma() {
  return describe_robot(DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot",
                        OpenParameters::kAbsentRows);
}

/// Torque of an estimate beside that of the truth, on a motion that was not fitted.
double torque_error(const LinearModel& model, const VectorXd& beta, const VectorXd& truth) {
  const Recording other = test::multisine(model, truth, {.seed = 99});
  const MatrixXd tau = model.torque(other.q, other.dq, other.ddq, beta);
  return (tau - other.tau).norm() / other.tau.norm();
}

MotionOptions options_of(StateMethod method) {
  MotionOptions options;
  options.state.method = method;
  options.average_periods = false;
  return options;
}

FitData data_of(const LinearModel& model, const MotionSource& source, const RowOptions& rows) {
  FitData data;
  data.summary = summarise(model, source, rows);
  data.rows = rows_of(model, source, rows);
  return data;
}

TEST(Fit, FindsTheTruthOfAPeriodicMotionExactly) {
  const DescribedRobot robot = puma();
  const VectorXd truth = test::plausible_beta(robot.linear, 1);
  const MotionSource source =
      motion_of(test::multisine(robot.linear, truth, {}), options_of(StateMethod::kSpectral));
  const FitData data = data_of(robot.linear, source, {.decimation = 1, .still_speed = 0});
  for (const FitMethod method : {FitMethod::kLs, FitMethod::kWls, FitMethod::kSvd}) {
    FitOptions options;
    options.methods = {method};
    options.dropped_directions = 0;
    const MethodFit fit = fit_methods(robot.linear, data, options).front();
    EXPECT_LT((fit.estimate.beta - truth).norm(), 1e-7 * truth.norm());
  }
}

TEST(Fit, FindsTheTruthThroughFiltersAndQuantisation) {
  const DescribedRobot robot = puma();
  const VectorXd truth = test::plausible_beta(robot.linear, 2);
  const MotionSource source =
      motion_of(test::multisine(robot.linear, truth,
                                {.seconds = 20, .torque_noise = 0.5, .encoder_step = 1e-4}),
                options_of(StateMethod::kLowPass));
  const FitData data = data_of(robot.linear, source, {});
  FitOptions options;
  options.methods = {FitMethod::kLs,  FitMethod::kWls, FitMethod::kIrls,   FitMethod::kRidge,
                     FitMethod::kSvd, FitMethod::kRls, FitMethod::kKalman, FitMethod::kLms};
  for (const MethodFit& fit : fit_methods(robot.linear, data, options)) {
    const double error = torque_error(robot.linear, fit.estimate.beta, truth);
    // noise alone allows 1 %; least mean squares has not converged yet
    EXPECT_LT(error, fit.method == FitMethod::kLms ? 0.2 : 0.02)
        << fit_method_names()[static_cast<std::size_t>(fit.method)];
  }
}

TEST(Fit, SummariesOfPartsAreTheSummaryOfTheWhole) {
  const DescribedRobot robot = puma();
  const VectorXd truth = test::plausible_beta(robot.linear, 3);
  const RowOptions rows{.decimation = 4, .still_speed = 0.01};
  RecordingSummary sum = empty_summary(robot.linear.columns, robot.linear.size());
  std::vector<RowSource> all;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const MotionSource source =
        motion_of(test::multisine(robot.linear, truth, {.torque_noise = 0.2, .seed = seed}),
                  options_of(StateMethod::kLowPass));
    merge(sum, summarise(robot.linear, source, rows));
    all.push_back(rows_of(robot.linear, source, rows));
  }
  const TorqueFactor whole = factor_of(joined(all), robot.linear.columns, robot.linear.size());
  const VectorXd one = weighted_least_squares(sum.equations).beta;
  const VectorXd other = weighted_least_squares(whole).beta;
  EXPECT_LT((one - other).norm(), 1e-12 * other.norm());
  EXPECT_EQ(sum.recordings, 3);
}

TEST(Fit, ALargeFileIsReadInPiecesWithTheSameResult) {
  const DescribedRobot robot = puma();
  const VectorXd truth = test::plausible_beta(robot.linear, 4);
  Recording recording = test::multisine(robot.linear, truth, {.seconds = 60, .torque_noise = 0.2});
  recording.dq.resize(0, 0);
  recording.ddq.resize(0, 0);
  const std::string path = test::temporary_path("pieces.csv");
  write_recording(recording, path);
  MotionOptions options = options_of(StateMethod::kLowPass);
  options.state.cutoff_hz = 20;
  const auto fit = [&](std::size_t stream_above) {
    options.stream_above = stream_above;
    const MotionSource source = motion_of_file(path, options);
    return factor_of(rows_of(robot.linear, source, {.decimation = 5, .still_speed = 0.01}),
                     robot.linear.columns, robot.linear.size());
  };
  const TorqueFactor whole = fit(1'000'000'000), pieces = fit(0);
  EXPECT_EQ(whole.samples(), pieces.samples());
  const VectorXd one = weighted_least_squares(whole).beta,
                 other = weighted_least_squares(pieces).beta;
  EXPECT_LT((one - other).norm(), 1e-8 * one.norm());
}

TEST(Fit, HeldOutPartsAreNotFitted) {
  const DescribedRobot robot = puma();
  const VectorXd truth = test::plausible_beta(robot.linear, 5);
  const MotionSource source =
      motion_of(test::multisine(robot.linear, truth, {}), options_of(StateMethod::kLowPass));
  Index all = 0, first = 0, last = 0;
  double end = 0, begin = 1e9;
  source.pieces([&](const StreamPiece& piece) { all += piece.motion.samples(); });
  part_of(source, 0, 0.6).pieces([&](const StreamPiece& piece) {
    first += piece.motion.samples();
    end = std::max(end, piece.motion.time.maxCoeff());
  });
  part_of(source, 0.6, 1).pieces([&](const StreamPiece& piece) {
    last += piece.motion.samples();
    begin = std::min(begin, piece.motion.time.minCoeff());
  });
  EXPECT_EQ(first + last, all);
  EXPECT_LT(end, begin);
  EXPECT_NEAR(static_cast<double>(first) / static_cast<double>(all), 0.6, 0.01);
}

TEST(Hierarchy, RobotsShareInertiaAndKeepTheirFriction) {
  const DescribedRobot robot = puma();
  const LinearModel& model = robot.linear;
  RobotSummaries all = empty_summaries(model);
  std::vector<VectorXd> truths;
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    VectorXd truth = test::plausible_beta(model, 7);
    for (int i = 0; i < model.size(); ++i) {
      const ParameterKind kind = model.parameters[static_cast<std::size_t>(i)].kind;
      if (kind == ParameterKind::kViscous || kind == ParameterKind::kCoulomb ||
          kind == ParameterKind::kOffset) {
        truth[i] *= 1 + 0.5 * static_cast<double>(seed);
      }
    }
    const MotionSource source =
        motion_of(test::multisine(model, truth, {.torque_noise = 0.2, .seed = seed}),
                  options_of(StateMethod::kRecorded));
    all.robots.emplace("robot" + std::to_string(seed),
                       summarise(model, source, {.decimation = 1, .still_speed = 0}));
    truths.push_back(truth);
  }
  const HierarchyFit fit = fit_own_friction(model, all);
  ASSERT_EQ(fit.robots.size(), 3U);
  for (std::size_t r = 0; r < 3; ++r) {
    const VectorXd beta = fit.robots[r].beta(fit);
    EXPECT_LT(torque_error(model, beta, truths[r]), 0.01);
    const VectorXd error = (fit.robots[r].own_beta - truths[r](fit.own)).cwiseAbs();
    EXPECT_TRUE((error.array() < 5 * fit.robots[r].own_stddev.array()).all());
    EXPECT_GT(fit.robots[r].own_stddev.minCoeff(), 0);
  }
  // as one robot their friction is nobody's
  const VectorXd one = weighted_least_squares(pooled(all).equations).beta;
  EXPECT_GT(torque_error(model, one, truths[0]),
            3 * torque_error(model, fit.robots[0].beta(fit), truths[0]));
}

TEST(SimulatedMotion, FollowsWhatItTracks) {
  const DescribedRobot robot =
      describe_robot(DYNGEN_SOURCE_DIR "/robots/puma560.robot", OpenParameters::kAsWritten);
  VectorXd beta(robot.linear.size());
  for (int i = 0; i < robot.linear.size(); ++i) {
    beta[i] = robot.linear.parameters[static_cast<std::size_t>(i)].value.value();
  }
  const Recording recording =
      test::multisine(robot.linear, beta, {.seconds = 1, .sample_time = 0.001});
  Motion reference{0.001, recording.time, recording.q, recording.dq, recording.ddq, recording.tau};
  const Motion motion = simulate_tracking(robot.linear, beta, reference, {.frequency = 10});
  EXPECT_LT((motion.q - reference.q).cwiseAbs().maxCoeff(), 0.02);
  // what it says of itself is what the model says of its motion
  const MatrixXd tau = robot.linear.torque(motion.q, motion.dq, motion.ddq, beta);
  EXPECT_LT((tau - motion.tau).cwiseAbs().maxCoeff(), 1e-8 * tau.cwiseAbs().maxCoeff());
  EXPECT_THROW(simulate_tracking(robot.linear, beta, reference, {.frequency = 1000}),
               std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
