// SPDX-License-Identifier: MIT
// Ripple above the band of the equations, as users of dynid have it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "runtime/recordings/reader.h"
#include "runtime/recordings/trajectory_file.h"
#include "tests/runtime/dynid/diagnosis_schema.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/shared_data.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;

constexpr double kOrder = 381, kAmplitude = 0.6, kPhase = 0.8;

class RippleTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("ripple_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  [[nodiscard]] std::string arm() const {
    std::ofstream(path("arm.robot")) << "name arm\nnumber_link 2\nsigma 0 0\nal 0 0\nd 0 0.5\n"
                                        "th 0 0\nr 0 0\nm 8 4\nmX 2 0.8\nmY 0 0\nmZ 0 0\n"
                                        "XX 0.02 0.01\nXY 0 0\nXZ 0 0\nYY 0.7 0.25\nYZ 0 0\n"
                                        "ZZ 0.7 0.25\nIA 0.5 0.3\nFs 0.5 0.2\nFv 3 1.5\noff 0 0\n"
                                        "taumax 400 200\ngy 9.81\nstop\n";
    return path("arm.robot");
  }

  /// Sines of several frequencies, which both joints do not share.
  void waves(const std::string& name, double seconds) const {
    const Index samples = 1 + std::lround(seconds / 0.004);
    Trajectory trajectory;
    trajectory.time = Eigen::VectorXd::LinSpaced(samples, 0, seconds);
    for (auto* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq}) part->resize(samples, 2);
    for (Index k = 0; k < samples; ++k) {
      for (Index j = 0; j < 2; ++j) {
        double q = 0, dq = 0, ddq = 0;
        for (const double hz : {0.11, 0.31, 0.73}) {
          const double w = 2 * std::numbers::pi * hz * (j == 0 ? 1 : 1.37);
          const double t = trajectory.time[k], a = 0.25;
          q += a * (1 - std::cos(w * t));
          dq += a * w * std::sin(w * t);
          ddq += a * w * w * std::cos(w * t);
        }
        trajectory.q(k, j) = q;
        trajectory.dq(k, j) = dq;
        trajectory.ddq(k, j) = ddq;
      }
    }
    write_trajectory(trajectory, path(name));
  }

  /// run.csv: the arm at 500 Hz, and a ripple of this amplitude in the recorded torque of joint 1.
  void record(double amplitude) const {
    waves("motion.csv", 40);
    const Outcome run =
        dynid("simulate " + arm() + " --trajectory " + path("motion.csv") + " -o " +
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

  fs::path folder_;
};

TEST_F(RippleTest, AFitFindsTheOrder) {
  record(kAmplitude);
  const Outcome fit = dynid("fit " + arm() + " " + path("run.csv") + " --json " + path("fit.json") +
                            " --report " + path("fit.html"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  EXPECT_NE(fit.out.find("ripple, periods per turn"), std::string::npos) << fit.out;
  expect_the_ripple(Json::parse(content(path("fit.json")))["ripple"]);
  const Json page = test::page_document(content(path("fit.html")));
  EXPECT_NE(page.dump().find("Order spectrum of the torque"), std::string::npos);
}

TEST_F(RippleTest, AFitOfNoRippleFindsNone) {
  record(0);
  const Outcome fit = dynid("fit " + arm() + " " + path("run.csv") + " --json " + path("fit.json"));
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
  const Outcome run = dynid("diagnose " + arm() + " " + path("run.csv") + " --json " +
                            path("findings.json") + " -o " + path("improved.robot"));
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
