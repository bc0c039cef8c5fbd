// SPDX-License-Identifier: MIT
// The closed loop before and after a diagnosis, on recordings of simulated robots.
#include "runtime/tools/dynid/diagnose/forward_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

#include "runtime/recordings/trajectory_file.h"
#include "tests/runtime/dynid/diagnosis_schema.h"
#include "tests/runtime/dynid/made_diagnosis.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using test::content;
using test::dynid;
using test::Outcome;

constexpr const char* kPuma3 = DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot";
constexpr const char* kLoop = " --controller pd --bandwidth 3 --rate 500 ";

/// A sum of three slow sines on each joint.
std::string motion(const std::string& name, double seconds, double phase) {
  constexpr double kAmplitudes[] = {0.5, 0.35, 0.12}, kFrequencies[] = {0.13, 0.31, 0.63};
  const Index samples = 1 + std::lround(seconds / 0.01);
  Trajectory trajectory;
  trajectory.time = VectorXd::LinSpaced(samples, 0, seconds);
  for (auto* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq}) part->setZero(samples, 3);
  for (Index k = 0; k < samples; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int h = 0; h < 3; ++h) {
        const double w = 2 * std::numbers::pi * (kFrequencies[h] + 0.017 * j);
        const double angle = w * trajectory.time[k] + phase + 1.3 * h + 0.9 * j;
        trajectory.q(k, j) += kAmplitudes[h] * std::sin(angle);
        trajectory.dq(k, j) += kAmplitudes[h] * w * std::cos(angle);
        trajectory.ddq(k, j) -= kAmplitudes[h] * w * w * std::sin(angle);
      }
    }
  }
  const std::string path = test::temporary_path(name);
  write_trajectory(trajectory, path);
  return path;
}

/// The plant's recording of a motion.
std::string recorded(const std::string& name, const std::string& plant,
                     const std::string& trajectory, const std::string& sensors) {
  const std::string path = test::temporary_path(name);
  const Outcome run = dynid("simulate " + std::string(kPuma3) + " --plant " + plant +
                            " --trajectory " + trajectory + " -o " + path + kLoop + sensors);
  EXPECT_EQ(run.exit_code, 0) << run.out;
  return path;
}

/// The recording as it is, without a filter.
MotionSource unfiltered(const std::string& path) {
  MotionOptions options;
  options.state.method = StateMethod::kRecorded;
  options.average_periods = false;
  return motion_of_file(path, options);
}

/// A diagnosis of the made robot that found nothing, or another fit.
DiagnosisReport report_with(const VectorXd& before, const VectorXd& after) {
  const DescribedRobot& robot = test::made_robot();
  Diagnosis diagnosis;
  diagnosis.verdict = Verdict::kClean;
  for (Index i = 0; i < before.size(); ++i) {
    diagnosis.base_parameters.push_back(
        {robot.linear.parameters[static_cast<std::size_t>(i)].name, before[i], after[i], 0});
  }
  diagnosis.fit.point.beta = after;
  return diagnosis_report(std::move(diagnosis), robot, EffectCatalogue());
}

ForwardTask task_of(const std::string& recording, const std::string& trajectory) {
  ForwardTask task;
  task.loop.controller = "pd";
  task.loop.bandwidth = 3;
  task.loop.rate = 500;
  task.recordings = {unfiltered(recording)};
  if (!trajectory.empty()) task.commanded = {read_trajectory(trajectory)};
  return task;
}

TEST(ForwardSimulation, OfTheTruthIsTheRecording) {
  const DescribedRobot& robot = test::made_robot();
  const VectorXd beta = robot.grouping * robot.standard;
  const std::string trajectory = motion("t.csv", 3, 0.3);
  const std::string recording = recorded("r.csv", kPuma3, trajectory, "");
  const DiagnosisReport report = report_with(beta, beta);
  const ForwardComparison same =
      compare_forward(report, robot, EffectCatalogue(), task_of(recording, trajectory));
  EXPECT_EQ(same.before.why_not, "");
  ASSERT_EQ(same.before.position.size(), 3);
  // the file of the fit has its parameters to the last digits; where a joint stands and starts
  // again, rounding decides the step of the integration
  EXPECT_LT(same.before.position.maxCoeff(), 1e-7);
  EXPECT_LT(same.before.torque.maxCoeff(), 1e-3);
  EXPECT_EQ(same.after.position, same.before.position);
  // without what was commanded the loop lags behind what it did
  const ForwardComparison again =
      compare_forward(report, robot, EffectCatalogue(), task_of(recording, ""));
  EXPECT_GT(again.before.position.minCoeff(), 1e-4);
  EXPECT_LT(again.before.position.maxCoeff(), 0.1);
}

TEST(ForwardSimulation, SaysWhatNoBodyHas) {
  const DescribedRobot& robot = test::made_robot();
  const VectorXd beta = robot.grouping * robot.standard;
  VectorXd impossible = beta;
  for (Index i = 0; i < beta.size(); ++i) {
    if (robot.linear.parameters[static_cast<std::size_t>(i)].kind == ParameterKind::kInertial) {
      impossible[i] = -beta[i];
    }
  }
  const std::string trajectory = motion("t.csv", 3, 0.3);
  const std::string recording = recorded("r.csv", kPuma3, trajectory, "");
  const ForwardComparison result = compare_forward(
      report_with(impossible, beta), robot, EffectCatalogue(), task_of(recording, trajectory));
  EXPECT_NE(result.before.why_not.find("The mass matrix of the model alone is not positive "
                                       "definite"),
            std::string::npos)
      << result.before.why_not;
  EXPECT_EQ(result.before.position.size(), 0);
  EXPECT_EQ(result.after.why_not, "");
  EXPECT_EQ(result.after.position.size(), 3);
}

TEST(ForwardSimulation, WantsAMotionThatCoversItsRecording) {
  const DescribedRobot& robot = test::made_robot();
  const VectorXd beta = robot.grouping * robot.standard;
  const std::string recording = recorded("r.csv", kPuma3, motion("t.csv", 3, 0.3), "");
  try {
    compare_forward(report_with(beta, beta), robot, EffectCatalogue(),
                    task_of(recording, motion("brief.csv", 2, 0.3)));
    ADD_FAILURE() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("found a motion from 0 to 2 s, expected one that"),
              std::string::npos)
        << error.what();
  }
}

/// Rows of the terminal's table by their names: values of the three joints.
VectorXd values_of(const std::string& text, const std::string& row) {
  const std::size_t place = text.find(row);
  VectorXd values = VectorXd::Constant(3, -1);
  if (place == std::string::npos) return values;
  std::istringstream line(text.substr(place + row.size()));
  for (double& value : values) line >> value;
  return values;
}

TEST(ForwardSimulation, IsNearerToTheRecordingWithWhatWasFound) {
  std::string text = content(kPuma3);
  text.insert(text.rfind("stop"), "effect load_friction joint=2 mu=0.1\n");
  const std::string plant = test::temporary_path("plant.robot");
  std::ofstream(plant) << text;
  const std::string sensors = "--encoder 1e-5 --torque-noise 0.3 --seed 3";
  const std::string train = motion("ta.csv", 20, 0.3), proof = motion("tb.csv", 10, 2.1);
  const std::string a = recorded("a.csv", plant, train, sensors),
                    b = recorded("b.csv", plant, proof, sensors);
  const std::string page = test::temporary_path("d.html");
  const std::string call = "diagnose " + std::string(kPuma3) + " " + a + " --holdout " + b +
                           " --cutoff 15 --report " + page;
  const Outcome run = dynid(call + kLoop + "--encoder 1e-5 --commanded " + proof);
  ASSERT_EQ(run.exit_code, 0) << run.out;
  ASSERT_NE(run.out.find("load_friction"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("controller pd, 3 Hz, on the motion that was commanded"),
            std::string::npos)
      << run.out;
  const VectorXd position_alone = values_of(run.out, "position, alone"),
                 position = values_of(run.out, "position, findings"),
                 torque_alone = values_of(run.out, "torque, alone"),
                 torque = values_of(run.out, "torque, findings");
  EXPECT_GT(position[1], 0);
  EXPECT_LT(position[1], 0.6 * position_alone[1]) << run.out;
  EXPECT_GT(torque[1], 0.28);  // the noise, within its chance
  EXPECT_LT(torque[1], 0.6 * torque_alone[1]) << run.out;
  EXPECT_NE(content(page).find("Simulated before and after"), std::string::npos);
  EXPECT_EQ(test::page_fault(content(page)), "");
}

TEST(ForwardSimulation, IsAskedForInTheRightWords) {
  const std::string call =
      "diagnose " + std::string(kPuma3) + " a.csv --holdout b.csv --holdout c.csv ";
  const auto expect = [&](const std::string& options, int code, const std::string& words) {
    const Outcome run = dynid(call + options);
    EXPECT_EQ(run.exit_code, code) << run.out;
    EXPECT_NE(run.out.find(words), std::string::npos) << run.out;
  };
  expect("--bandwidth 3", 2, "--controller");
  expect("--controller pid", 2, "--controller");
  expect("--controller pd --commanded t.csv", 1,
         "--commanded: found 1 motions, expected 2, one for each --holdout");
  expect("--controller pd --residual-only", 1, "--controller: found --residual-only too");
}

}  // namespace
}  // namespace dyngen::runtime
