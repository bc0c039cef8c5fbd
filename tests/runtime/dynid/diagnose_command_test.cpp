// SPDX-License-Identifier: MIT
// dynid diagnose as its users call it, on recordings of a simulated arm.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "runtime/recordings/reader.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/recordings/writer.h"
#include "tests/runtime/dynid/diagnosis_schema.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;

class Diagnose : public testing::Test {
 protected:
  static constexpr const char* kRobot = DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot";

  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("diagnose_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// The robot file with further rows.
  std::string robot(const std::string& name, const std::string& rows) const {
    std::string text = content(kRobot);
    text.insert(text.rfind("stop"), rows);
    std::ofstream(path(name)) << text;
    return path(name);
  }

  /// A motion of all joints at five frequencies each.
  std::string trajectory(double seconds, int seed) const {
    const Index samples = 1 + std::lround(seconds / 0.01);
    Trajectory motion;
    motion.time = Eigen::VectorXd::LinSpaced(samples, 0, seconds);
    for (auto* part : {&motion.q, &motion.dq, &motion.ddq}) {
      *part = Eigen::MatrixXd::Zero(samples, 3);
    }
    for (Index k = 0; k < samples; ++k) {
      for (Index j = 0; j < 3; ++j) {
        for (int f = 1; f <= 5; ++f) {
          const double w = 2 * std::numbers::pi * (0.1 * f + 0.013 * static_cast<double>(j));
          const double phase = 1.7 * f * f + 0.9 * static_cast<double>(j) + 2.3 * seed;
          const double x = w * motion.time[k] + phase, size = 0.45 / std::sqrt(f);
          motion.q(k, j) += size * std::sin(x);
          motion.dq(k, j) += size * w * std::cos(x);
          motion.ddq(k, j) -= size * w * w * std::sin(x);
        }
      }
    }
    const std::string name = path("motion" + std::to_string(seed) + ".csv");
    write_trajectory(motion, name);
    return name;
  }

  /// A recording of a plant with further rows, under control by the file's model.
  std::string record(const std::string& name, const std::string& rows, int seed,
                     double seconds = 24) const {
    const Outcome run =
        dynid("simulate " + std::string(kRobot) + " --plant " + robot("plant.robot", rows) +
              " --trajectory " + trajectory(seconds, seed) + " --controller ct --encoder 1e-5 " +
              "--torque-noise 0.6,0.6,0.3 --rate 500 --seed " + std::to_string(seed) + " -o " +
              path(name));
    EXPECT_EQ(run.exit_code, 0) << run.out;
    return path(name);
  }

  [[nodiscard]] Outcome diagnose(const std::string& arguments) const {
    return dynid("diagnose " + std::string(kRobot) + " " + arguments + " --json " + path("d.json") +
                 " --report " + path("d.html") + " -o " + path("d.robot"));
  }
  [[nodiscard]] Json json() const { return Json::parse(content(path("d.json"))); }

  fs::path folder_;
};

TEST_F(Diagnose, NamesFrictionThatTheModelLeavesOut) {
  const std::string rows = "effect load_friction joint=3 mu=0.12\n";
  const std::string train = record("a.csv", rows, 1), test = record("b.csv", rows, 2);
  const Outcome run = diagnose(train + " --holdout " + test);
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  EXPECT_EQ(json()["verdict"], "explained") << run.out;
  ASSERT_EQ(json()["findings"].size(), 1u) << run.out;
  const Json finding = json()["findings"][0];
  EXPECT_EQ(finding["family"], "load_friction") << run.out;
  EXPECT_EQ(finding["joint"], 3) << run.out;
  const Json& heldout = json()["heldout"];
  EXPECT_LT(heldout["rms_after"][2].get<double>(), 0.95 * heldout["rms_before"][2].get<double>());
  EXPECT_EQ(test::markup_fault(content(path("d.html"))), "");
  EXPECT_NE(run.out.find("of joint 3, probability"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("written: " + path("d.html")), std::string::npos) << run.out;
  // the file that it writes leaves less of the recordings, and compiles
  const auto left = [&](const std::string& file) {
    const Outcome check = dynid("check " + file + " " + test + " --json " + path("check.json"));
    EXPECT_EQ(check.exit_code, 0) << check.out;
    return Json::parse(content(path("check.json")))["recordings"][0]["rms"][2].get<double>();
  };
  EXPECT_LT(left(path("d.robot")), 0.8 * left(kRobot));
  // it is known then: taken off, and there is nothing left to find
  const Outcome again = dynid("diagnose " + path("d.robot") + " " + train + " --holdout " + test +
                              " --json " + path("again.json"));
  ASSERT_EQ(again.exit_code, 0) << again.out;
  EXPECT_EQ(Json::parse(content(path("again.json")))["verdict"], "clean") << again.out;
}

TEST_F(Diagnose, FindsNothingWhereNothingIs) {
  const Outcome run = diagnose(record("a.csv", "", 3));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(json()["verdict"], "clean") << run.out;
  EXPECT_EQ(json()["findings"].size(), 0u);
  EXPECT_GT(json()["certificate"].size(), 50u);
  EXPECT_GT(json()["undecidable"].size(), 0u);
  // all parameters are those of a fit
  EXPECT_EQ(dynid("check " + path("d.robot") + " " + path("a.csv")).exit_code, 0);
}

TEST_F(Diagnose, SaysTheSameTwice) {
  const std::string train = record("a.csv", "effect stribeck joint=2 Fs=14 vs=0.1\n", 4, 12);
  ASSERT_EQ(diagnose(train).exit_code, 0);
  const std::string json = content(path("d.json")), page = content(path("d.html")),
                    file = content(path("d.robot"));
  ASSERT_EQ(diagnose(train).exit_code, 0);
  EXPECT_EQ(content(path("d.json")), json);
  EXPECT_EQ(content(path("d.html")), page);
  EXPECT_EQ(content(path("d.robot")), file);
}

TEST_F(Diagnose, ExplainsWhatAnotherSimulatorLeaves) {
  Recording recording = read_recording(record("a.csv", "", 5));
  const std::string call = path("sim.csv") + " --residual-only";
  write_recording(recording, path("sim.csv"));
  const Outcome without = diagnose(call);
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.out.find("there are no columns tausim1 .. tausim3"), std::string::npos)
      << without.out;
  // a simulator that knows all but the viscous friction's bend
  recording.tau_sim = recording.tau;
  std::uint32_t state = 1;
  for (Index k = 0; k < recording.samples(); ++k) {
    for (Index j = 0; j < 3; ++j) {
      state = state * 1664525u + 1013904223u;
      recording.tau_sim(k, j) += 0.2 * (static_cast<double>(state >> 8) / 8388608.0 - 1);
    }
    const double q = recording.q(k, 0);
    recording.tau_sim(k, 0) -= 1.5 * q * q * q;
  }
  write_recording(recording, path("sim.csv"));
  const Outcome run = diagnose(call);
  ASSERT_EQ(run.exit_code, 0) << run.out;
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  ASSERT_GE(json()["findings"].size(), 1u) << run.out;
  EXPECT_EQ(json()["findings"][0]["joint"], 1) << run.out;
  // the file keeps its own parameters
  EXPECT_NE(content(path("d.robot")).find("\nFs       5.9  8.1  4.4\n"), std::string::npos);
}

TEST_F(Diagnose, SaysWhatIsWrong) {
  const std::string train = record("a.csv", "", 6, 3);
  const auto expect = [](const Outcome& outcome, int code, const std::string& words) {
    EXPECT_EQ(outcome.exit_code, code) << outcome.out;
    EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out;
  };
  expect(dynid("diagnose " + std::string(kRobot)), 2, "there is no recording");
  expect(diagnose(train + " --false-alarm 0.7"), 2, "--false-alarm");
  expect(diagnose(path("missing.csv")), 1, "missing.csv");
  expect(dynid("diagnose " + std::string(DYNGEN_SOURCE_DIR "/robots/planar2r.robot ") + train), 1,
         "joints");
  expect(dynid("diagnose " + robot("e.robot", "effect stribeck joint=2 Fs=*\n") + " " + train), 1,
         "effect 'stribeck' has no numbers");
  expect(diagnose(train + " --effects " + path("nowhere")), 1, "nowhere");
  EXPECT_FALSE(fs::exists(path("d.json")));
}

TEST_F(Diagnose, RefusesToAnswerFromTooLittle) {
  const Outcome run = diagnose(record("a.csv", "", 7, 1.5));
  EXPECT_EQ(run.exit_code, 3) << run.out;
  EXPECT_NE(run.out.find("too few"), std::string::npos) << run.out;
  EXPECT_EQ(json()["verdict"], "insufficient_data");
  EXPECT_EQ(test::schema_faults(json()), std::vector<std::string>{});
  EXPECT_EQ(test::markup_fault(content(path("d.html"))), "");
  EXPECT_FALSE(fs::exists(path("d.robot")));
}

}  // namespace
}  // namespace dyngen::runtime
