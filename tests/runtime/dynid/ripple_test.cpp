// SPDX-License-Identifier: MIT
// Ripple above the band of the equations, as users of dynid have it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "runtime/recordings/reader.h"
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

constexpr double kOrder = 381, kAmplitude = 0.6, kPhase = 0.8;

class RippleTest : public test::RecordedArm {
 protected:
  /// run.csv: the arm at 500 Hz, and a ripple of this amplitude in the recorded torque of joint 1.
  void record(double amplitude) const {
    waves("motion.csv", 40);
    const Outcome run =
        dynid("simulate " + arm("arm.robot", "") + " --trajectory " + path("motion.csv") + " -o " +
              path("plain.csv") + " --controller ff --rate 500 --encoder 2e-6 --encoder-noise 1");
    ASSERT_EQ(run.exit_code, 0) << run.out;
    const Recording plain = read_recording(path("plain.csv"));
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, 1);
    std::ofstream file(path("run.csv"));
    file << "time,q1,q2,tau1,tau2\n";
    for (Index k = 0; k < plain.samples(); ++k) {
      const double ripple = amplitude * std::cos(kOrder * plain.q(k, 0) - kPhase);
      file << fmt::format("{},{},{},{},{}\n", plain.time[k], plain.q(k, 0), plain.q(k, 1),
                          plain.tau(k, 0) + ripple + normal(random),
                          plain.tau(k, 1) + 0.5 * normal(random));
    }
  }

  static void expect_the_ripple(const Json& ripple) {
    ASSERT_EQ(ripple.size(), 2U);
    EXPECT_TRUE(ripple[0]["judged"]);
    ASSERT_EQ(ripple[0]["lines"].size(), 1U) << ripple.dump(1);
    EXPECT_EQ(ripple[1]["lines"].size(), 0U) << ripple.dump(1);
    const Json& line = ripple[0]["lines"][0];
    EXPECT_EQ(line["kind"], "torque");
    EXPECT_NEAR(line["order"]["value"].get<double>(), kOrder, 0.005 * kOrder);
    EXPECT_NEAR(line["both"]["amplitude"]["value"].get<double>(), kAmplitude, 0.1);
    EXPECT_FALSE(line["directions_differ"]) << line.dump(1);
  }
};

TEST_F(RippleTest, AFitFindsTheOrder) {
  record(kAmplitude);
  const Outcome fit = dynid("fit " + arm("arm.robot", "") + " " + path("run.csv") + " --json " +
                            path("fit.json") + " --report " + path("fit.html"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  EXPECT_NE(fit.out.find("ripple, periods per turn"), std::string::npos) << fit.out;
  expect_the_ripple(Json::parse(content(path("fit.json")))["ripple"]);
  const Json page = test::page_document(content(path("fit.html")));
  EXPECT_NE(page.dump().find("Order spectrum of the torque"), std::string::npos);
}

TEST_F(RippleTest, AFitOfNoRippleFindsNone) {
  record(0);
  const Outcome fit =
      dynid("fit " + arm("arm.robot", "") + " " + path("run.csv") + " --json " + path("fit.json"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  const Json ripple = Json::parse(content(path("fit.json")))["ripple"];
  ASSERT_EQ(ripple.size(), 2U);
  for (const Json& joint : ripple) {
    EXPECT_TRUE(joint["judged"]);
    EXPECT_EQ(joint["lines"].size(), 0U) << joint.dump(1);
    EXPECT_GT(joint["below"].get<double>(), 0);
    EXPECT_LT(joint["below"].get<double>(), kAmplitude);
  }
}

TEST_F(RippleTest, ADiagnosisWritesItIntoTheRobotFile) {
  record(kAmplitude);
  const Outcome run = dynid("diagnose " + arm("arm.robot", "") + " " + path("run.csv") +
                            " --json " + path("findings.json") + " -o " + path("improved.robot"));
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 3) << run.out;
  const Json json = Json::parse(content(path("findings.json")));
  EXPECT_EQ(test::schema_faults(json), std::vector<std::string>());
  expect_the_ripple(json["ripple"]);
  const std::string improved = content(path("improved.robot"));
  const std::size_t row = improved.find("effect cogging joint=1 ");
  ASSERT_NE(row, std::string::npos) << improved;
  EXPECT_EQ(improved.find("effect cogging", row + 1), std::string::npos) << improved;
  // the emitted torque has it
  const Outcome emitted =
      test::run_shell(DYNGEN " " + path("improved.robot") + " -o " + path("arm.c"));
  ASSERT_EQ(emitted.exit_code, 0) << emitted.out;
  // a fit of that file finds the same order, and names the effect
  const Outcome fit = dynid("fit " + path("improved.robot") + " " + path("run.csv") + " --json " +
                            path("fit.json"));
  ASSERT_TRUE(fit.exit_code == 0 || fit.exit_code == 3) << fit.out;
  const Json again = Json::parse(content(path("fit.json")))["ripple"];
  expect_the_ripple(again);
  EXPECT_EQ(again[0]["lines"][0]["found_as"], "cogging") << again.dump(1);
}

}  // namespace
}  // namespace dyngen::runtime
