// SPDX-License-Identifier: MIT
// dynid fit --hold: numbers of the robot file that are kept.
#include "runtime/tools/dynid/robot/held_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "gen/diagnostic/diagnostic.h"
#include "runtime/recordings/gzip.h"
#include "runtime/recordings/writer.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "tests/runtime/dynid/multisine.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/model_bridge.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;
using Words = std::vector<std::string>;

constexpr const char* kArm =
    "number_link 2\nsigma 0 0\nal 0 pi/2\nd 0 0.3\nm 1 *\nmX 0.5 0.2\nmY 0 0\nIA 0.1 *\nFs * 2\n"
    "joints base elbow\ngz 9.81\nstop\n";

Words held(const Words& words) { return held_numbers(test::parse_model(kArm), words).names; }

std::string refusal(const Words& words) {
  try {
    held(words);
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

TEST(HeldNumbers, AreNamedByLinksJointsRowsAndThemselves) {
  EXPECT_EQ(held({}), Words{});
  EXPECT_EQ(held({"all"}), (Words{"mX1", "m1", "IA1", "mX2", "Fs2"}));
  EXPECT_EQ(held({"links=1"}), (Words{"mX1", "m1"}));
  EXPECT_EQ(held({"joints=elbow,1"}), (Words{"IA1", "Fs2"}));
  EXPECT_EQ(held({"rows=MX,fs"}), (Words{"mX1", "mX2", "Fs2"}));
  EXPECT_EQ(held({"numbers=MX2,m1", "rows=IA"}), (Words{"m1", "IA1", "mX2"}));
}

TEST(HeldNumbers, SayWhatThereIs) {
  EXPECT_NE(refusal({"everything"}).find("--hold everything: expected all, links=1,2"),
            std::string::npos);
  EXPECT_NE(refusal({"links="}).find("expected all"), std::string::npos);
  EXPECT_NE(refusal({"link=1"}).find("expected all"), std::string::npos);
  EXPECT_NE(
      refusal({"links=3"}).find("there is no link '3': expected 1 to 2, or one of base, elbow"),
      std::string::npos);
  EXPECT_NE(refusal({"rows=MX,Fc"}).find("there is no row 'Fc': expected one of XX XY"),
            std::string::npos);
  EXPECT_NE(refusal({"numbers=Fs1"})
                .find("no number there to hold: '*' and absent rows are estimated. It has mX1 m1"),
            std::string::npos);
  EXPECT_NE(refusal({"numbers=MX"}).find("there is no link ''"), std::string::npos);
}

TEST(HeldNumbers, LeaveTheRestToItsOwnBaseParameters) {
  const std::string path = test::temporary_path("held.robot");
  std::ofstream(path) << "number_link 1\nal pi/2\nmX 1.2\nZZ 0.4\nIA *\nFs *\ngz 9.81\nstop\n";
  const DescribedRobot all = describe_robot(path, OpenParameters::kAsWritten);
  const DescribedRobot rest =
      describe_robot(path, OpenParameters::kAsWritten, {.hold = {"rows=ZZ"}});
  ASSERT_EQ(all.linear.size(), 3);  // ZZR1 MX1 FS1
  ASSERT_EQ(rest.linear.size(), 3);
  EXPECT_EQ(rest.linear.parameters[0].formula, "IA1; beside held ZZ1");
  const Recording motion =
      test::multisine(all.linear, Eigen::Vector3d(0.4 + 0.3, 1.2, 2), {.seconds = 1});
  const auto& held = *rest.held_torque;
  const Eigen::MatrixXd sum =
      held.model.torque(motion.q, motion.dq, motion.ddq, held.beta) +
      rest.linear.torque(motion.q, motion.dq, motion.ddq, Eigen::Vector3d(0.3, 1.2, 2));
  EXPECT_LT((sum - motion.tau).cwiseAbs().maxCoeff(), 1e-12 * motion.tau.cwiseAbs().maxCoeff());
}

class Hold : public testing::Test {
 protected:
  void SetUp() override {
    if (!gzip_available()) GTEST_SKIP() << "built without zlib";
  }
  static std::string case_file(const std::string& name) {
    return std::string(DYNGEN_SOURCE_DIR "/tests/data/cases/") + name;
  }
  Outcome fit(const std::string& arguments) const {
    return dynid("fit " + arguments + " -o " + id_ + " --json " + json_);
  }
  [[nodiscard]] Json json() const { return Json::parse(content(json_)); }
  [[nodiscard]] double value(const std::string& name) const {
    for (const Json& parameter : json()["parameters"]) {
      if (parameter["name"] == name) return parameter["value"];
    }
    return NAN;
  }
  const std::string id_ = test::temporary_path("id.robot");
  const std::string json_ = test::temporary_path("fit.json");
};

TEST_F(Hold, KeepsANumberThatTheFileKnows) {
  const std::string files =
      case_file("known_number/pk.robot") + " " + case_file("known_number/pend.csv.gz");
  const Outcome free = fit(files);
  EXPECT_LT(value("MX1"), 0.7) << free.out;  // 0.601: numbers are where a fit begins
  const Outcome run = fit(files + " --hold numbers=MX1");
  EXPECT_EQ(test::parse_model(content(id_)).joint(1).chi[index(Chi::kMX)].value,
            GiNaC::numeric(6, 5))
      << run.out;
  EXPECT_TRUE(std::isnan(value("MX1")));
  EXPECT_NE(run.out.find("held: mX1"), std::string::npos) << run.out;
  // all that the file knows
  const Outcome all = fit(files + " --hold all");
  EXPECT_NE(all.out.find("beside held ZZ1"), std::string::npos) << all.out;
  const RobotModel model = test::parse_model(content(id_));
  EXPECT_EQ(model.joint(1).chi[index(Chi::kZZ)].value, GiNaC::numeric(23, 50));
}

TEST_F(Hold, TheResidualIsThatOfTheFile) {
  const std::string recording = case_file("known_number/pend.csv.gz");
  ASSERT_NE(fit(case_file("known_number/pk.robot") + " " + recording + " --hold links=1").exit_code,
            1);
  const std::string check = test::temporary_path("check.json");
  ASSERT_EQ(dynid("check " + id_ + " " + recording + " --json " + check).exit_code, 0);
  const double fitted = json()["residual"][0]["rms"];
  const double left = Json::parse(content(check))["recordings"][0]["rms"][0];
  EXPECT_NEAR(left, fitted, 1e-9 * fitted);
}

TEST_F(Hold, FindsThePayloadOfAKnownArm) {
  const std::string files = case_file("payload_on_known_arm/pay.robot") + " " +
                            case_file("payload_on_known_arm/pay.csv.gz");
  const Outcome run = fit(files + " --hold links=1,2,3");
  std::map<std::string, double> found;
  for (const Json& parameter : json()["effects"]["list"][0]["parameters"]) {
    found[parameter["name"]] = parameter["value"];
  }
  EXPECT_NEAR(found["M"], 1.5, 0.02) << run.out;
  EXPECT_NEAR(found["MX"], 0.075, 0.01) << run.out;
  EXPECT_NEAR(found["MY"], -0.45, 0.01) << run.out;
  EXPECT_NEAR(found["MZ"], 0.03, 0.02) << run.out;  // +- 0.006
  // the last link itself, where the file leaves it open
  std::string text = content(case_file("payload_on_known_arm/pay.robot"));
  for (const char* row : {"m ", "mX ", "mY ", "mZ ", "XX ", "XY ", "XZ ", "YY ", "YZ ", "ZZ "}) {
    const std::size_t begin = text.find("\n" + std::string(row)) + 1;
    const std::size_t end = text.find('\n', begin);
    const std::size_t last = text.rfind(' ', end);
    text.replace(last, end - last, " *");
  }
  text.erase(text.find("effect payload"), std::string("effect payload\n").size());
  const std::string open = test::temporary_path("open.robot");
  std::ofstream(open) << text;
  const std::string recording = case_file("payload_on_known_arm/pay.csv.gz");
  const Outcome offered = fit(open + " " + recording);
  EXPECT_NE(offered.out.find("links 1, 2 of the file are all numbers and link 3 is unknown"),
            std::string::npos)
      << offered.out;
  const Outcome last = fit(open + " " + recording + " --hold links=1,2");
  EXPECT_NEAR(value("MX3"), 0.05 + 0.075, 0.01) << last.out;
  EXPECT_NEAR(value("MY3"), -0.3 - 0.45, 0.01) << last.out;
  // nothing but the payload is left: said, not tried
  const Outcome all = fit(files + " --hold all");
  EXPECT_EQ(all.exit_code, 1);
  EXPECT_NE(all.out.find("Hold fewer numbers"), std::string::npos) << all.out;
}

TEST_F(Hold, IsOfferedWhereTheFileLooksLikeIt) {
  const Outcome run = fit(case_file("payload_on_known_arm/pay.robot") + " " +
                          case_file("payload_on_known_arm/pay.csv.gz"));
  EXPECT_NE(run.out.find("links 1, 2, 3 of the file are all numbers and the payload is unknown"),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("--hold links=1,2,3"), std::string::npos) << run.out;
}

TEST_F(Hold, RefusesWhatItCannotGoWith) {
  const std::string files =
      case_file("known_number/pk.robot") + " " + case_file("known_number/pend.csv.gz");
  EXPECT_EQ(fit(files + " --hold links=2").exit_code, 1);
  const Outcome run = fit(files + " --hold all --consistent");
  EXPECT_EQ(run.exit_code, 1) << run.out;
}

}  // namespace
}  // namespace dyngen::runtime
