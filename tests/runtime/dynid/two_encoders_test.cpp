// SPDX-License-Identifier: MIT
// Two encoders on a joint, as users of dynid have them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runtime/recordings/reader.h"
#include "runtime/rules/decision_rules.h"
#include "tests/runtime/dynid/diagnosis_schema.h"
#include "tests/runtime/dynid/recorded_arm.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/shared_data.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;

class TwoEncodersTest : public test::RecordedArm {
 protected:
  /// An arm whose first gear gives: run.csv.
  void simulate_elastic() const {
    waves("motion.csv", 40);
    const std::string plant = arm("elastic.robot", "effect joint_elasticity joint=1 c=5e-5\n");
    const Outcome run = dynid(
        "simulate " + plant + " --trajectory " + path("motion.csv") + " -o " + path("run.csv") +
        " --controller ff --rate 500 --encoder 2e-6 --encoder-noise 1 --torque-noise 1");
    ASSERT_EQ(run.exit_code, 0) << run.out;
  }
};

TEST_F(TwoEncodersTest, ASimulatedGearThatGivesHasASecondEncoder) {
  simulate_elastic();
  const Recording run = read_recording(path("run.csv"));
  ASSERT_EQ(run.q_link.cols(), 2);
  EXPECT_TRUE(run.has_link(0));
  EXPECT_FALSE(run.has_link(1));
  // it carries its own weight, some 60 N m
  EXPECT_GT((run.q.col(0) - run.q_link.col(0)).cwiseAbs().maxCoeff(), 1e-3);
}

TEST_F(TwoEncodersTest, AFitFindsTheStiffnessThatWasSimulated) {
  simulate_elastic();
  const Outcome fit = dynid("fit " + open_arm() + " " + path("run.csv") + " --json " +
                            path("fit.json") + " --report " + path("fit.html"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  EXPECT_NE(fit.out.find("two encoders, 95 % intervals"), std::string::npos) << fit.out;
  const Json json = Json::parse(content(path("fit.json")));
  ASSERT_EQ(json["two_encoders"].size(), 1U);
  const Json& joint = json["two_encoders"][0];
  EXPECT_EQ(joint["joint"], 1);
  const Json& k = joint["stiffness"];
  EXPECT_TRUE(k["seen"]) << joint.dump(1);
  EXPECT_LE(k["low"], 2e4) << joint.dump(1);
  EXPECT_GE(k["high"], 2e4) << joint.dump(1);
  EXPECT_NEAR(k["value"].get<double>(), 2e4, 1e3) << joint.dump(1);
  EXPECT_NEAR(joint["delay"]["value"].get<double>(), 0, 2e-4);
  const Json page = test::page_document(content(path("fit.html")));
  EXPECT_NE(page.dump().find("Torque over wind-up of joint 1"), std::string::npos);
}

TEST_F(TwoEncodersTest, ADelayThatIsPutInIsFound) {
  simulate_elastic();
  Recording run = read_recording(path("run.csv"));
  const Index late = 3;  // samples of 2 ms
  const Index rest = run.samples() - late;
  std::ofstream file(path("late.csv"));
  file << "time,q1,q2,tau1,tau2,ql1\n";
  for (Index k = late; k < late + rest; ++k) {
    file << fmt::format("{},{},{},{},{},{}\n", run.time[k], run.q(k, 0), run.q(k, 1), run.tau(k, 0),
                        run.tau(k, 1), run.q_link(k - late, 0));
  }
  file.close();
  const Outcome fit =
      dynid("fit " + open_arm() + " " + path("late.csv") + " --json " + path("fit.json"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  const Json joint = Json::parse(content(path("fit.json")))["two_encoders"][0];
  EXPECT_NEAR(joint["delay"]["value"].get<double>(), 6e-3, 2e-4) << joint.dump(1);
  EXPECT_NEAR(joint["stiffness"]["value"].get<double>(), 2e4, 1e3) << joint.dump(1);
}

TEST_F(TwoEncodersTest, ADiagnosisHasThemAndTheSchemaHolds) {
  simulate_elastic();
  const Outcome run = dynid("diagnose " + arm("rigid.robot", "") + " " + path("run.csv") +
                            " --effort 1 --json " + path("findings.json"));
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 3) << run.out;
  const Json json = Json::parse(content(path("findings.json")));
  EXPECT_EQ(test::schema_faults(json), std::vector<std::string>());
  ASSERT_TRUE(json.contains("two_encoders")) << run.out;
  EXPECT_NEAR(json["two_encoders"][0]["stiffness"]["value"].get<double>(), 2e4, 1e3);
  EXPECT_NE(run.out.find("two encoders"), std::string::npos) << run.out;
}

TEST_F(TwoEncodersTest, ACheckNamesTheJoints) {
  simulate_elastic();
  const Outcome check = dynid("check " + arm("rigid.robot", "") + " " + path("run.csv") +
                              " --json " + path("check.json"));
  ASSERT_EQ(check.exit_code, 0) << check.out;
  EXPECT_NE(check.out.find("two encoders: joint 1;"), std::string::npos) << check.out;
  EXPECT_EQ(Json::parse(content(path("check.json")))["recordings"][0]["two_encoders"],
            Json::array({1}));
}

TEST_F(TwoEncodersTest, ACheckRefusesAnEncoderOfTheOtherSign) {
  simulate_elastic();
  Recording run = read_recording(path("run.csv"));
  std::ofstream file(path("wrong.csv"));
  file << "time,q1,q2,tau1,tau2,ql1\n";
  for (Index k = 0; k < run.samples(); ++k) {
    file << fmt::format("{},{},{},{},{},{}\n", run.time[k], run.q(k, 0), run.q(k, 1), run.tau(k, 0),
                        run.tau(k, 1), -run.q_link(k, 0));
  }
  file.close();
  const Outcome check = dynid("check " + arm("rigid.robot", "") + " " + path("wrong.csv"));
  EXPECT_EQ(check.exit_code, 1);
  EXPECT_NE(check.out.find("wrong.csv:1:22: error: found ql1 that runs against q1"),
            std::string::npos)
      << check.out;
}

constexpr const char* kRaw = "kr300/raw_A.mat";

/// The KUKA KR300: delays of 3.0 +- 0.1 ms, and stiffnesses that were published.
TEST_F(TwoEncodersTest, OfAnIndustrialRobotTheDelaysAreThreeMilliseconds) {
  const auto raw = test::shared_data(kRaw);
  const auto robot = test::shared_data("kr300/robot.robot");
  if (!raw || !robot) GTEST_SKIP() << test::skip_sentence(kRaw);
  std::ofstream(path("map.yaml"))
      << "time: {column: time_cont, unit: s}\n"
         "position: {columns: \"act_pos_mot_deg[{n}]\", unit: deg, side: joint}\n"
         "link_position: {columns: \"act_pos_se_deg[{n}]\", unit: deg, side: joint}\n"
         "torque: {columns: \"act_torque_abs_nm[{n}]\", unit: N m, side: motor}\n"
         "gears: [1798/7, 1872/7, 757/3, 221, 5032/21, 206793/1340]\n";
  const Outcome fit = dynid("fit " + *robot + " " + *raw + " --map " + path("map.yaml") +
                            " --json " + path("fit.json"));
  ASSERT_TRUE(fit.exit_code == 0 || fit.exit_code == 3) << fit.out;
  const Json joints = Json::parse(content(path("fit.json")))["two_encoders"];
  ASSERT_EQ(joints.size(), 3U) << fit.out;
  const std::array<double, 3> published = {4.6e6, 7.5e6, 4.1e6};
  for (std::size_t j = 0; j < 3; ++j) {
    const Json& joint = joints[j];
    EXPECT_NEAR(joint["delay"]["value"].get<double>(), 3.0e-3, 0.1e-3) << joint.dump(1);
    EXPECT_LE(joint["stiffness"]["low"].get<double>(), published[j]) << joint.dump(1);
    if (!joint["stiffness"]["high"].is_null()) {
      EXPECT_GE(joint["stiffness"]["high"].get<double>(), published[j]) << joint.dump(1);
    }
  }
}

}  // namespace
}  // namespace dyngen::runtime
