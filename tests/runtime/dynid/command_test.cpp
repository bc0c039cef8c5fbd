// SPDX-License-Identifier: MIT
// dynid as its users call it: what it prints, writes and returns.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/recordings/gzip.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;

using test::content;
using test::dynid;
using test::Outcome;

class Commands : public testing::Test {
 protected:
  static constexpr const char* kRobot = DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot";

  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    robot_ = describe_robot(kRobot, OpenParameters::kAbsentRows);
  }

  /// A recording of the robot in the test's folder.
  std::string record(const std::string& name, const test::MultisineOptions& options) {
    Recording recording =
        test::multisine(robot_.linear, test::plausible_beta(robot_.linear, 1), options);
    recording.dq.resize(0, 0);
    recording.ddq.resize(0, 0);
    const std::string path = (folder_ / name).string();
    write_recording(recording, path);
    return path;
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  fs::path folder_;
  DescribedRobot robot_;
};

TEST_F(Commands, HoldsOutAllRecordingsThatFollow) {
  const std::string call = "fit " + std::string(kRobot) + " " + record("a.csv", {.seed = 1}) +
                           " --holdout " + record("b.csv", {.seed = 2}) + " " +
                           record("c.csv", {.seed = 3}) + " --json " + path("fit.json");
  const Outcome fit = dynid(call);
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  const auto recordings = nlohmann::json::parse(content(path("fit.json")))["recordings"];
  ASSERT_EQ(recordings.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(recordings[i]["heldout"], i > 0) << i;
}

TEST_F(Commands, FitChecksAndSaysHowWell) {
  const std::string train = record("train.csv", {.seconds = 20, .torque_noise = 0.3});
  const std::string test =
      record(gzip_available() ? "test.csv.gz" : "test.csv", {.torque_noise = 0.3, .seed = 2});
  const Outcome fit = dynid("fit " + std::string(kRobot) + " " + train + " --holdout " + test +
                            " -o " + path("id.robot") + " --json " + path("fit.json"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  EXPECT_NE(fit.out.find("condition number"), std::string::npos);
  EXPECT_NE(fit.out.find("bias susceptibility"), std::string::npos);

  const auto json = nlohmann::json::parse(content(path("fit.json")));
  EXPECT_EQ(json["schema"], "dynid.fit/1");
  EXPECT_EQ(json["parameters"].size(), static_cast<std::size_t>(robot_.linear.size()));
  const Eigen::VectorXd truth = test::plausible_beta(robot_.linear, 1);
  for (std::size_t i = 0; i < json["parameters"].size(); ++i) {
    const auto& parameter = json["parameters"][i];
    EXPECT_EQ(parameter["name"], robot_.linear.parameters[i].name);
    EXPECT_NEAR(parameter["value"].get<double>(), truth[static_cast<Eigen::Index>(i)],
                6 * parameter["std"].get<double>() + 0.02);
  }
  for (const auto& joint : json["residual"]) EXPECT_LT(joint["heldout_percent"], 5);

  const Outcome check = dynid("check " + path("id.robot") + " " + train);
  EXPECT_EQ(check.exit_code, 0) << check.out;
  EXPECT_NE(check.out.find("residual"), std::string::npos);
}

TEST_F(Commands, AccumulatedAndMergedRecordingsFitAsRecordingsDo) {
  std::string all, parts;
  for (const std::uint64_t seed : {1U, 2U}) {
    const std::string file =
        record("r" + std::to_string(seed) + ".csv", {.torque_noise = 0.3, .seed = seed});
    const std::string part = path("p" + std::to_string(seed) + ".qr");
    const Outcome accumulate = dynid("accumulate " + std::string(kRobot) + " " + file +
                                     " --cutoff 10 --still 0.05 -o " + part);
    ASSERT_EQ(accumulate.exit_code, 0) << accumulate.out;
    all += " " + file;
    parts += " " + part;
  }
  ASSERT_EQ(dynid("merge" + parts + " -o " + path("all.qr")).exit_code, 0);
  ASSERT_EQ(
      dynid("fit " + std::string(kRobot) + " " + path("all.qr") + " --json " + path("merged.json"))
          .exit_code,
      0);
  ASSERT_EQ(dynid("fit " + std::string(kRobot) + all + " --cutoff 10 --still 0.05 --json " +
                  path("direct.json"))
                .exit_code,
            0);
  const auto merged = nlohmann::json::parse(content(path("merged.json")));
  const auto direct = nlohmann::json::parse(content(path("direct.json")));
  for (std::size_t i = 0; i < merged["parameters"].size(); ++i) {
    EXPECT_NEAR(merged["parameters"][i]["value"].get<double>(),
                direct["parameters"][i]["value"].get<double>(), 1e-10);
    // noise at the fits of the parts, and at the fit of all
    EXPECT_NEAR(merged["parameters"][i]["std"].get<double>(),
                direct["parameters"][i]["std"].get<double>(),
                0.3 * direct["parameters"][i]["std"].get<double>());
  }
}

TEST_F(Commands, RobotsOfOneTypeKeepTheirOwnFriction) {
  std::string parts;
  for (const std::string name : {"left", "right"}) {
    const std::string file = record(
        name + ".csv", {.seconds = 20, .torque_noise = 0.1, .seed = name == "left" ? 3U : 4U});
    ASSERT_EQ(dynid("accumulate " + std::string(kRobot) + " " + file + " --name " + name + " -o " +
                    path(name + ".qr"))
                  .exit_code,
              0);
    parts += " " + path(name + ".qr");
  }
  const Outcome fit =
      dynid("fit " + std::string(kRobot) + parts + " --own-friction -o " + path("arm.robot"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  for (const std::string name : {"left", "right"}) {
    EXPECT_EQ(
        dynid("check " + path("arm." + name + ".robot") + " " + path(name + ".csv")).exit_code, 0);
  }
}

TEST_F(Commands, WhatSumsCannotAnswerIsSaidAtOnce) {
  std::ofstream(path("files.txt")) << path("none.csv") << "\n";  // would be an error of its own
  const std::string list = " --list " + path("files.txt");
  const Outcome method = dynid("fit " + std::string(kRobot) + list + " --method irls");
  EXPECT_EQ(method.exit_code, 1);
  EXPECT_NE(method.out.find("method irls looks at single samples"), std::string::npos)
      << method.out;
  const Outcome friction = dynid("fit " + std::string(kRobot) + list + " --own-friction");
  EXPECT_EQ(friction.exit_code, 1);
  EXPECT_NE(friction.out.find("--own-friction goes with .qr files"), std::string::npos);
}

TEST_F(Commands, SayWhatIsNotSeenAndExitWith3) {
  Recording recording = test::multisine(robot_.linear, test::plausible_beta(robot_.linear, 1), {});
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(recording.samples(), 1);
  for (Eigen::MatrixXd* matrix : {&recording.q, &recording.dq, &recording.ddq}) {
    matrix->col(2) = zero;
  }
  recording.tau = robot_.linear.torque(recording.q, recording.dq, recording.ddq,
                                       test::plausible_beta(robot_.linear, 1));
  write_recording(recording, path("still.csv"));
  const Outcome fit = dynid("fit " + std::string(kRobot) + " " + path("still.csv"));
  EXPECT_EQ(fit.exit_code, 3) << fit.out;
  EXPECT_NE(fit.out.find("not seen in these recordings"), std::string::npos);
  EXPECT_NE(fit.out.find("joint 3"), std::string::npos) << fit.out;
}

TEST_F(Commands, WrongInputIsPointedAtAndExitsWith1) {
  std::ofstream(path("bad.csv")) << "time,q1,q2,q3,tau1,tau2,tau3\n0,0,0,0,0,0,0\n"
                                    "0.01,0,zero,0,0,0,0\n0.02,0,0,0,0,0,0\n";
  const Outcome bad = dynid("fit " + std::string(kRobot) + " " + path("bad.csv"));
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_NE(bad.out.find("bad.csv:3:8: error:"), std::string::npos) << bad.out;
  const Outcome missing = dynid("fit " + path("none.robot") + " " + path("bad.csv"));
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.out.find("none.robot"), std::string::npos);
  std::ofstream(path("bad.qr")) << "dyngenqr and then nothing";
  EXPECT_EQ(dynid("fit " + std::string(kRobot) + " " + path("bad.qr")).exit_code, 1);
}

TEST_F(Commands, WrongUsageExitsWith2) {
  EXPECT_EQ(dynid("").exit_code, 2);
  EXPECT_EQ(dynid("fit").exit_code, 2);
  EXPECT_EQ(dynid("fit " + std::string(kRobot)).exit_code, 2);
  EXPECT_EQ(dynid("fit " + std::string(kRobot) + " a.csv --method best").exit_code, 2);
  EXPECT_EQ(dynid("--help").exit_code, 0);
}

TEST_F(Commands, AFailedFitLeavesOldOutputsAsTheyWere) {
  std::ofstream(path("id.robot")) << "old";
  std::ofstream(path("bad.csv")) << "time,q1\n";
  EXPECT_EQ(dynid("fit " + std::string(kRobot) + " " + path("bad.csv") + " -o " + path("id.robot"))
                .exit_code,
            1);
  EXPECT_EQ(content(path("id.robot")), "old");
}

}  // namespace
}  // namespace dyngen::runtime
