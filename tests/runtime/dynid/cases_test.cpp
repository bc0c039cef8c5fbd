// SPDX-License-Identifier: MIT
// Recordings and robot files on which dynid was wrong, with the right answers.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "runtime/recordings/trajectory_file.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::test {
namespace {

namespace fs = std::filesystem;
using CaseJson = nlohmann::json;

/// Base parameters of the arm of most cases.
const std::map<std::string, double> kArm2 = {
    {"ZZR1", 1.2404}, {"MXR1", 1.8},  {"MY1", 0.04}, {"FV1", 1.5}, {"FS1", 3.0}, {"ZZ2", 0.0752},
    {"MX2", 0.3},     {"MY2", -0.02}, {"IA2", 0.2},  {"FV2", 0.8}, {"FS2", 1.5}};

class Cases : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("cases_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  static std::string file(const std::string& name) {
    return std::string(DYNGEN_SOURCE_DIR "/tests/data/cases/") + name;
  }
  [[nodiscard]] std::string made(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// Runs dynid with --json. @return  the answer
  CaseJson answer(const std::string& arguments, int exit_code) {
    outcome_ = dynid(arguments + " --json " + made("answer.json"));
    EXPECT_EQ(outcome_.exit_code, exit_code) << outcome_.out;
    const std::string text = content(made("answer.json"));
    return text.empty() ? CaseJson() : CaseJson::parse(text);
  }

  static std::map<std::string, CaseJson> parameters(const CaseJson& fit) {
    std::map<std::string, CaseJson> all;
    for (const CaseJson& parameter : fit.at("parameters")) all[parameter.at("name")] = parameter;
    return all;
  }

  /// Each within 5 % or five standard deviations.
  void expect_near(const CaseJson& fit, const std::map<std::string, double>& truth) const {
    auto found = parameters(fit);
    for (const auto& [name, value] : truth) {
      ASSERT_TRUE(found.contains(name)) << name << "\n" << outcome_.out;
      const double std =
          found[name].at("std").is_number() ? found[name].at("std").get<double>() : 0;
      EXPECT_NEAR(found[name].at("value").get<double>(), value,
                  std::max(0.05 * std::abs(value), 5 * std))
          << name << "\n"
          << outcome_.out;
    }
  }

  fs::path folder_;
  Outcome outcome_;
};

TEST_F(Cases, TimeThatStartsAgainIsTwoRuns) {
  const std::string run = file("restart/run.csv.gz"), robot = file("restart/arm2.robot");
  expect_near(answer("fit " + robot + " " + run, 0), kArm2);
  EXPECT_NE(outcome_.out.find("time starts again"), std::string::npos) << outcome_.out;

  const CaseJson check = answer("check " + file("restart/true2.robot") + " " + run, 0);
  const CaseJson& recording = check.at("recordings").at(0);
  EXPECT_NEAR(recording.at("rms").at(0).get<double>(), 0.09, 0.03);
  EXPECT_NEAR(recording.at("rms").at(1).get<double>(), 0.016, 0.006);
  EXPECT_GT(recording.at("equations").get<double>(), 150);

  const std::string good = file("gap/run.csv.gz");
  const CaseJson both = answer("fit " + robot + " " + good + " " + run, 0);
  expect_near(both, kArm2);
  for (const CaseJson& each : both.at("recordings")) {
    EXPECT_GT(each.at("equations").at(0).get<double>(), 100) << outcome_.out;
  }
  const CaseJson held = answer("fit " + robot + " " + good + " --holdout " + run, 0);
  for (const CaseJson& joint : held.at("residual")) {
    EXPECT_GT(joint.at("heldout_percent").get<double>(), 0.01) << outcome_.out;
    EXPECT_LT(joint.at("heldout_percent").get<double>(), 5) << outcome_.out;
  }
  const Outcome sum = dynid("accumulate " + robot + " " + run + " -o " + made("a.qr"));
  EXPECT_EQ(sum.exit_code, 0) << sum.out;
  expect_near(answer("fit " + robot + " " + made("a.qr"), 0), kArm2);
}

TEST_F(Cases, TorqueThatIsZeroGivesNoEquations) {
  const std::string call = file("dead_torque/arm2.robot") + " " + file("dead_torque/run.csv.gz");
  const CaseJson fit = answer("fit " + call, 3);
  EXPECT_NE(outcome_.out.find("tau2 is 0 throughout"), std::string::npos) << outcome_.out;
  auto found = parameters(fit);
  for (const char* name : {"IA2", "FV2", "FS2"}) EXPECT_EQ(found[name].at("seen"), "no") << name;
  expect_near(fit, {{"ZZR1", 1.2404}, {"MXR1", 1.8}, {"FV1", 1.5}, {"FS1", 3.0}});
  EXPECT_TRUE(fit.at("residual").at(1).at("rms").is_null());

  const CaseJson diagnosis = answer("diagnose " + call, 3);
  EXPECT_EQ(diagnosis.at("verdict"), "insufficient_data");
}

TEST_F(Cases, PosesThatAreHeldGiveGravity) {
  const std::string call = file("static_poses/arm2.robot") + " " + file("static_poses/st.csv.gz");
  const CaseJson fit = answer("fit " + call + " --still 0", 3);
  const std::map<std::string, double> gravity = {
      {"MXR1", 1.8}, {"MY1", 0.04}, {"MX2", 0.3}, {"MY2", -0.02}};
  expect_near(fit, gravity);
  for (auto& [name, parameter] : parameters(fit)) {
    if (!gravity.contains(name)) {
      EXPECT_EQ(parameter.at("seen"), "no") << name;
    }
  }
  // without it no joint moves, and nothing is fitted
  const Outcome moving = dynid("fit " + call);
  EXPECT_EQ(moving.exit_code, 3);
  EXPECT_NE(moving.out.find("--still 0"), std::string::npos) << moving.out;
  const Outcome sum = dynid("accumulate " + call + " --still 0 -o " + made("s.qr"));
  EXPECT_EQ(sum.exit_code, 0) << sum.out;
  EXPECT_EQ(answer("diagnose " + call, 3).at("verdict"), "insufficient_data");
}

TEST_F(Cases, RobotThatStandsIsSaid) {
  // joints are slower than asked
  const std::string call = file("gap/arm2.robot") + " " + file("gap/run.csv.gz");
  for (const std::string command : {"fit ", "check "}) {
    const std::string robot =
        command == "check " ? file("restart/true2.robot") + " " + file("gap/run.csv.gz") : call;
    const Outcome outcome = dynid(command + robot + " --still 1000");
    EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
    EXPECT_NE(outcome.out.find("--still 1000"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.out.find("0.0 %"), std::string::npos) << outcome.out;
  }
  const Outcome sum = dynid("accumulate " + call + " --still 1000 -o " + made("n.qr"));
  EXPECT_EQ(sum.exit_code, 3) << sum.out;
  EXPECT_FALSE(fs::exists(made("n.qr")));
}

TEST_F(Cases, ShortRunDoesNotDecideTheCutoff) {
  const CaseJson fit = answer("fit " + file("gap/arm2.robot") + " " + file("gap/run.csv.gz"), 0);
  expect_near(fit, kArm2);
  const double cutoff = fit.at("recordings").at(0).at("cutoff_hz");
  EXPECT_NEAR(cutoff, 9.8, 2) << outcome_.out;
  for (const CaseJson& joint : fit.at("residual")) {
    EXPECT_LT(joint.at("percent").get<double>(), 0.8) << outcome_.out;
  }
}

TEST_F(Cases, DegreesAreSaid) {
  const std::string call = file("degrees/arm2.robot") + " " + file("degrees/run.csv.gz");
  const Outcome fit = dynid("fit " + call);
  EXPECT_EQ(fit.exit_code, 3) << fit.out;
  EXPECT_NE(fit.out.find("degrees"), std::string::npos) << fit.out;
  EXPECT_EQ(fit.out.find("yes"), std::string::npos) << fit.out;
  const CaseJson diagnosis = answer("diagnose " + call, 3);
  EXPECT_EQ(diagnosis.at("verdict"), "insufficient_data");
  EXPECT_TRUE(diagnosis.at("findings").empty());
}

TEST_F(Cases, TurnedSignOfTorqueIsAsked) {
  const Outcome fit =
      dynid("fit " + file("torque_sign/arm2.robot") + " " + file("torque_sign/run.csv.gz"));
  EXPECT_EQ(fit.exit_code, 3) << fit.out;
  EXPECT_NE(fit.out.find("sign of tau2"), std::string::npos) << fit.out;
}

TEST_F(Cases, MissingGravityIsNoPhysics) {
  const std::string call =
      file("no_gravity_row/nog.robot") + " " + file("no_gravity_row/run2_0.csv.gz");
  const Outcome fit = dynid("fit " + call);
  EXPECT_EQ(fit.exit_code, 3) << fit.out;
  EXPECT_NE(fit.out.find("gravity"), std::string::npos) << fit.out;
  const CaseJson diagnosis = answer("diagnose " + call, 3);
  EXPECT_EQ(diagnosis.at("verdict"), "insufficient_data");
  EXPECT_TRUE(diagnosis.at("findings").empty());
}

#ifdef DYNGEN_WITH_BOOST
TEST_F(Cases, ATrajectoryIsTheCommandedMotionOfInstruments) {
  constexpr Eigen::Index kSamples = 2001;
  runtime::Trajectory asked;
  asked.time = Eigen::VectorXd::LinSpaced(kSamples, 0, 8);
  for (auto* part : {&asked.q, &asked.dq, &asked.ddq}) part->resize(kSamples, 2);
  for (Eigen::Index j = 0; j < 2; ++j) {
    const double w = 2.2 + 1.3 * static_cast<double>(j);
    const Eigen::ArrayXd phase = w * asked.time.array();
    asked.q.col(j) = phase.sin() + 0.4 * (2.7 * phase).sin();
    asked.dq.col(j) = w * (phase.cos() + 2.7 * 0.4 * (2.7 * phase).cos());
    asked.ddq.col(j) = -w * w * (phase.sin() + 2.7 * 2.7 * 0.4 * (2.7 * phase).sin());
  }
  write_trajectory(asked, made("asked.csv"));
  const std::string robot = file("restart/true2.robot");
  const Outcome simulated =
      dynid("simulate " + robot + " --trajectory " + made("asked.csv") +
            " --controller ff --torque-noise 0.1 --encoder 1e-4 -o " + made("run.csv"));
  ASSERT_EQ(simulated.exit_code, 0) << simulated.out;

  const std::string call = "fit " + file("gap/arm2.robot") + " " + made("run.csv") +
                           " --period off --method iv --method wls --tracked ";
  const CaseJson fit = answer(call + made("asked.csv"), 0);
  expect_near(fit, kArm2);
  const CaseJson& test = fit.at("methods").at(0).at("hausman");
  EXPECT_GT(test.at("relevance").get<double>(), 0.3) << outcome_.out;
  EXPECT_LT(test.at("largest_move").get<double>(), 3) << outcome_.out;
  // a recording of the motion is taken too
  EXPECT_EQ(dynid(call + made("run.csv")).exit_code, 0);
  // one that does not cover it is refused
  runtime::Trajectory half;
  half.time = asked.time.head(kSamples / 2);
  half.q = asked.q.topRows(kSamples / 2);
  half.dq = asked.dq.topRows(kSamples / 2);
  half.ddq = asked.ddq.topRows(kSamples / 2);
  write_trajectory(half, made("half.csv"));
  const Outcome refused = dynid(call + made("half.csv"));
  EXPECT_EQ(refused.exit_code, 1) << refused.out;
  EXPECT_NE(refused.out.find("same zero of time"), std::string::npos) << refused.out;
}

#endif

#ifdef DYNGEN_WITH_CERES
TEST_F(Cases, ExactZerosOfAPriorAreNumbers) {
  // masses are not identifiable: the prior decides them
  const CaseJson fit =
      answer("fit --consistent " + file("restart/true2.robot") + " " + file("gap/run.csv.gz"), 0);
  const CaseJson& standard = fit.at("consistent").at("standard");
  EXPECT_NEAR(standard.at(9).get<double>(), 4, 0.2) << outcome_.out;
  EXPECT_NEAR(standard.at(23).get<double>(), 2, 0.1) << outcome_.out;
}
#endif

}  // namespace
}  // namespace dyngen::test
