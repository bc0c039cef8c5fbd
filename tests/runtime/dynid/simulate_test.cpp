// SPDX-License-Identifier: MIT
// dynid simulate as its users call it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "runtime/recordings/reader.h"
#include "runtime/recordings/trajectory_file.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;

using test::content;
using test::dynid;
using test::Outcome;

class Simulate : public testing::Test {
 protected:
  static constexpr const char* kRobot = DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot";

  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("simulate_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    write_trajectory(waves(6), path("waves.csv"));
    std::ofstream(path("step.csv")) << "time,q1,q2,q3\n0,0.3,-0.2,0.4\n1,0.3,-0.2,0.4\n";
  }

  static Trajectory waves(double seconds) {
    const Index samples = 1 + std::lround(seconds / 0.01);
    Trajectory trajectory;
    trajectory.time = Eigen::VectorXd::LinSpaced(samples, 0, seconds);
    for (auto* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq}) part->resize(samples, 3);
    for (Index k = 0; k < samples; ++k) {
      for (Index j = 0; j < 3; ++j) {
        const double w = 2 * std::numbers::pi * (0.4 + 0.13 * static_cast<double>(j)),
                     t = trajectory.time[k];
        trajectory.q(k, j) = 0.7 * (1 - std::cos(w * t));
        trajectory.dq(k, j) = 0.7 * w * std::sin(w * t);
        trajectory.ddq(k, j) = 0.7 * w * w * std::cos(w * t);
      }
    }
    return trajectory;
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }
  [[nodiscard]] Outcome simulate(const std::string& trajectory, const std::string& options,
                                 const std::string& robot = kRobot) const {
    return dynid("simulate " + robot + " --trajectory " + path(trajectory) + " -o " +
                 path("run.csv") + " " + options);
  }
  /// The robot file with a row replaced.
  [[nodiscard]] std::string changed(const std::string& keyword, const std::string& row) const {
    std::istringstream lines(content(kRobot));
    std::ofstream output(path("changed.robot"));
    for (std::string line; std::getline(lines, line);) {
      std::string word;
      std::istringstream(line) >> word;
      output << (word == keyword ? row : line) << "\n";
    }
    return path("changed.robot");
  }

  fs::path folder_;
};

TEST_F(Simulate, WritesARecordingThatCheckUnderstands) {
  for (const char* controller : {"pd", "gravity", "ff", "ct"}) {
    const Outcome run = simulate("waves.csv", std::string("--encoder 1e-5 --velocity-cutoff 100 "
                                                          "--torque-noise 0.1 --controller ") +
                                                  controller);
    ASSERT_EQ(run.exit_code, 0) << run.out;
    EXPECT_NE(run.out.find(std::string("controller ") + controller), std::string::npos);
    EXPECT_NE(run.out.find("seed 1\n"), std::string::npos);
    const Recording recording = read_recording(path("run.csv"));
    EXPECT_EQ(recording.samples(), 6001);
    EXPECT_EQ(recording.joints(), 3);
    const Outcome check = dynid("check " + std::string(kRobot) + " " + path("run.csv") +
                                " --json " + path("check.json"));
    ASSERT_EQ(check.exit_code, 0) << check.out;
    // the residual is the noise, not the torque: a few per cent
    const std::string json = content(path("check.json"));
    const std::size_t at = json.find("\"percent\"");
    ASSERT_NE(at, std::string::npos);
    double worst = 0;
    std::istringstream numbers(json.substr(json.find('[', at) + 1));
    for (int j = 0; j < 3; ++j) {
      double percent = 100;
      char comma = 0;
      numbers >> percent >> comma;
      worst = std::max(worst, percent);
    }
    EXPECT_LT(worst, 5) << check.out;
  }
}

TEST_F(Simulate, TheSameSeedGivesTheSameFile) {
  const std::string options =
      "--torque-noise 0.5,0.2,0.1 --duration 1 --encoder 1e-4 --velocity-cutoff 60 --delay 0.0015 "
      "--seed ";
  ASSERT_EQ(simulate("waves.csv", options + "7").exit_code, 0);
  const std::string first = content(path("run.csv"));
  ASSERT_EQ(simulate("waves.csv", options + "7").exit_code, 0);
  EXPECT_EQ(content(path("run.csv")), first);
  ASSERT_EQ(simulate("waves.csv", options + "8").exit_code, 0);
  EXPECT_NE(content(path("run.csv")), first);
}

TEST_F(Simulate, MakesAStepResponse) {
  const Outcome run =
      simulate("step.csv", "--start 0,0,0 --duration 3 --truth " + path("truth.csv"));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  const Recording truth = read_recording(path("truth.csv"));
  EXPECT_EQ(truth.samples(), 3001);
  EXPECT_TRUE(truth.q.row(0).isZero(0));
  EXPECT_EQ(truth.ddq.rows(), truth.samples());
  // computed torque of 3 Hz leaves what the friction at rest holds
  EXPECT_TRUE((truth.q.row(3000) - Eigen::RowVector3d(0.3, -0.2, 0.4)).isZero(0.05));
  EXPECT_NE(run.out.find("written: " + path("run.csv") + ", " + path("truth.csv")),
            std::string::npos);
}

TEST_F(Simulate, AListIsOneWord) {
  const Outcome run =
      dynid("simulate --start -0.1,0.2,-0.3 --encoder 0 " + std::string(kRobot) + " --trajectory " +
            path("step.csv") + " --duration 0.1 -o " + path("run.csv"));
  ASSERT_EQ(run.exit_code, 0) << run.out;
  const Recording recording = read_recording(path("run.csv"));
  EXPECT_TRUE(recording.q.row(0).isApprox(Eigen::RowVector3d(-0.1, 0.2, -0.3)));
}

TEST_F(Simulate, AnotherPlantIsFollowedWorse) {
  const auto worst_error = [](const std::string& out) {  // of joint 2, second number of its row
    std::istringstream row(out.substr(out.find("\n2 ") + 3));
    std::string name;
    double rms = 0;
    row >> name >> rms;
    return rms;
  };
  const Outcome same = simulate("waves.csv", "");
  const std::string moments = changed("mX", "mX 0 3 0.5");
  const Outcome other = simulate("waves.csv", "--plant " + moments);
  ASSERT_EQ(other.exit_code, 0) << other.out;
  EXPECT_GT(worst_error(other.out), 5 * worst_error(same.out));
}

TEST_F(Simulate, LimitsTorqueByTheFile) {
  const std::string limited = path("limited.robot");
  std::string text = content(kRobot);
  text.insert(text.rfind("stop"), "taumax 20 60 15\n");
  std::ofstream(limited) << text;
  const Outcome on = simulate("waves.csv", "", limited);
  ASSERT_EQ(on.exit_code, 0) << on.out;
  Recording run = read_recording(path("run.csv"));
  EXPECT_LE(run.tau.col(1).cwiseAbs().maxCoeff(), 60);
  ASSERT_EQ(simulate("waves.csv", "--saturate off", limited).exit_code, 0);
  run = read_recording(path("run.csv"));
  EXPECT_GT(run.tau.col(1).cwiseAbs().maxCoeff(), 60);
}

TEST_F(Simulate, SaysWhatIsWrong) {
  const auto expect = [&](const Outcome& outcome, int code, const std::string& words) {
    EXPECT_EQ(outcome.exit_code, code) << outcome.out;
    EXPECT_NE(outcome.out.find(words), std::string::npos) << outcome.out;
  };
  expect(simulate("missing.csv", ""), 1, "missing.csv");
  expect(simulate("waves.csv", "", DYNGEN_SOURCE_DIR "/robots/ur10e.robot"), 1,
         "are unknown: expected numbers");
  expect(simulate("waves.csv", "", DYNGEN_SOURCE_DIR "/robots/planar2r.robot"), 1,
         "has 3 joints, planar2r has 2");
  expect(simulate("waves.csv", "", changed("Fs", "Fs 1 -1 1")), 1, "'Fs' is negative");
  expect(simulate("waves.csv", "--encoder 1,2"), 1, "--encoder: found 2 values, expected 1 or 3");
  expect(simulate("waves.csv", "--rate 0 --delay 0.1"), 1,
         "a continuous controller has exact sensors");
  expect(simulate("waves.csv", "--controller pid"), 2, "--controller");
  expect(simulate("waves.csv", "--bandwidth -1"), 2, "--bandwidth");
  expect(simulate("waves.csv", "--bandwidth 300 --rate 100"), 3, "does not stay bounded");
  expect(simulate("waves.csv", "--controller pd --friction-compensation on"), 1, "found pd");
  EXPECT_FALSE(fs::exists(path("run.csv")));
}

}  // namespace
}  // namespace dyngen::runtime
