// SPDX-License-Identifier: MIT
// Robots whose gears give, as users of dynid simulate them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "runtime/recordings/reader.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/effects/recorded_effects.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::content;
using test::dynid;
using test::Outcome;

class SimulatedGears : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        fs::path(testing::TempDir()) /
        (std::string("gears_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// An upright arm of two joints. @param friction  the rows Fs and Fv
  [[nodiscard]] std::string arm(const std::string& name, const std::string& friction,
                                const std::string& rows, const std::string& rotors = "0.5 0.3") {
    std::ofstream(path(name)) << "name arm\nnumber_link 2\nsigma 0 0\nal 0 0\nd 0 0.5\nth 0 0\n"
                                 "r 0 0\nm 8 4\nmX 2 0.8\nmY 0 0\nmZ 0 0\nXX 0.02 0.01\nXY 0 0\n"
                                 "XZ 0 0\nYY 0.7 0.25\nYZ 0 0\nZZ 0.7 0.25\nIA "
                              << rotors << "\n"
                              << friction << "off 0 0\ntaumax 150 60\ngy 9.81\n"
                              << rows << "stop\n";
    return path(name);
  }

  /// Two sines of both joints, from a stand without acceleration. @param hz  of the first; the
  /// second is 1.3 times as fast
  [[nodiscard]] std::string waves(const std::string& name, double seconds, double amplitude,
                                  double hz) {
    const Index samples = 1 + std::lround(seconds / 0.002);
    Trajectory trajectory;
    trajectory.time = VectorXd::LinSpaced(samples, 0, seconds);
    for (auto* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq}) part->resize(samples, 2);
    for (Index k = 0; k < samples; ++k) {
      const double t = trajectory.time[k];
      for (Index j = 0; j < 2; ++j) {
        const double w = 2 * std::numbers::pi * hz * (j == 0 ? 1 : 1.3);
        trajectory.q(k, j) = amplitude * (std::sin(w * t) - std::sin(2 * w * t) / 2);
        trajectory.dq(k, j) = amplitude * w * (std::cos(w * t) - std::cos(2 * w * t));
        trajectory.ddq(k, j) = amplitude * w * w * (2 * std::sin(2 * w * t) - std::sin(w * t));
      }
    }
    write_trajectory(trajectory, path(name));
    return path(name);
  }

  [[nodiscard]] Outcome simulate(const std::string& robot, const std::string& trajectory,
                                 const std::string& options) const {
    return dynid("simulate " + robot + " --trajectory " + trajectory + " -o " + path("run.csv") +
                 " --truth " + path("truth.csv") + " " + options);
  }

  fs::path folder_;
};

/// Of a row of the table: "1 name  rms  worst rad  peak ...".
double peak_of(const std::string& out, int joint) {
  std::istringstream row(out.substr(out.find(fmt::format("\n{} j", joint)) + 3));
  std::string name, unit;
  double rms = 0, worst = 0, peak = -1;
  row >> name >> rms >> worst >> unit >> peak;
  return peak;
}

constexpr const char* kDry = "Fs 25 10\nFv 3 1.5\n";
constexpr const char* kSlight = "Fs 0.1 0.05\nFv 3 1.5\n";

TEST_F(SimulatedGears, StickAndSlipLeavesNoMoreTorqueThanTheDriveGives) {
  const std::string slow = waves("slow.csv", 6, 0.3, 0.25);
  for (const char* effect :
       {"joint_elasticity joint=1 c=1e-4\neffect joint_elasticity joint=2 c=2e-4",
        "joint_elasticity_cubic joint=1 c=2e-4 c3=-1e-9",
        "joint_elasticity_cubic joint=2 c=1e-4 c3=1e-7", "backlash joint=1 gap=0.002 t0=3",
        "backlash joint=2 gap=0.002 t0=2\neffect joint_elasticity joint=2 c=1e-4"}) {
    const std::string robot = arm("dry.robot", kDry, std::string("effect ") + effect + "\n");
    const Outcome run = simulate(robot, slow, "--controller pd --bandwidth 2");
    ASSERT_EQ(run.exit_code, 0) << run.out;
    const Recording recording = read_recording(path("run.csv"));
    const Recording truth = read_recording(path("truth.csv"));
    const VectorXd largest = recording.tau.cwiseAbs().colwise().maxCoeff();
    EXPECT_LE(largest[0], 150) << effect;
    EXPECT_LE(largest[1], 60) << effect;
    // the drive stands now and then; its torque is that of the loop, which knows no more than this
    EXPECT_GT((truth.dq.col(0).array() == 0).count(), 100) << effect;
    // gravity, friction, and what moves the arm by a radian a second or less
    EXPECT_LE(largest[0], 110) << effect;
    for (const int joint : {1, 2}) {
      EXPECT_NEAR(peak_of(run.out, joint), largest[joint - 1], 1e-4 * largest[joint - 1])
          << run.out;
    }
  }
}

TEST_F(SimulatedGears, TheTableHasTheFilesPeakTorque) {
  const std::string motion = waves("waves.csv", 2, 0.4, 0.5);
  const std::string robot = arm("gain.robot", kDry, "effect joint_torque_gain joint=2 gain=0.3\n");
  const Outcome run = simulate(robot, motion, "--torque-noise 2 --delay 0.0015");
  ASSERT_EQ(run.exit_code, 0) << run.out;
  const Recording recording = read_recording(path("run.csv"));
  for (const int joint : {1, 2}) {
    const double largest = recording.tau.col(joint - 1).cwiseAbs().maxCoeff();
    EXPECT_NEAR(peak_of(run.out, joint), largest, 1e-4 * largest) << run.out;
  }
}

TEST_F(SimulatedGears, AGainOfTheReadingMultipliesWhatFrictionHolds) {
  // standing under its own weight and friction: the model's torque in this motion is less
  std::ofstream(path("stand.csv")) << "time,q1,q2\n0,0.2,0.1\n1,0.2,0.1\n";
  const std::string robot = arm("gain.robot", kDry, "effect joint_torque_gain joint=1 gain=0.2\n");
  ASSERT_EQ(simulate(robot, path("stand.csv"), "--controller pd --start 0.2,0.1").exit_code, 0);
  const Recording with = read_recording(path("run.csv"));
  const std::string plain = arm("plain.robot", kDry, "");
  ASSERT_EQ(simulate(plain, path("stand.csv"), "--controller pd --start 0.2,0.1").exit_code, 0);
  const Recording without = read_recording(path("run.csv"));
  EXPECT_GT(without.tau.col(0).cwiseAbs().maxCoeff(), 1);
  EXPECT_LT((with.tau.col(0) - 1.2 * without.tau.col(0)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST_F(SimulatedGears, AgreeWithTheFirstOrderWhereTheMotionIsSlow) {
  const std::string motion = waves("slow.csv", 4, 0.4, 0.5);
  const std::string rows = "effect joint_elasticity joint=1 c=1e-4\n";
  const std::string robot = arm("elastic.robot", "Fs 0 0\nFv 3 1.5\n", rows);
  ASSERT_EQ(simulate(robot, motion, "--rate 0 --controller ff").exit_code, 0);
  const Recording truth = read_recording(path("truth.csv"));
  // the same motion of the drives in a rigid robot, and what the effect's text adds
  const DescribedRobot described = describe_robot(robot, OpenParameters::kAsWritten);
  Recording given = truth;
  given.tau.setZero();
  const MatrixXd effect =
      recorded_torque(described, effect_instances(described.model, EffectCatalogue()), given);
  const MatrixXd rigid = described.linear.torque(truth.q, truth.dq, truth.ddq,
                                                 described.grouping * described.standard);
  const Index settled = truth.samples() / 2, end = truth.samples() - settled - 10;
  const VectorXd without = (truth.tau - rigid).col(0).segment(settled, end);
  const VectorXd left = (truth.tau - rigid - effect).col(0).segment(settled, end);
  const double size = effect.col(0).segment(settled, end).norm();
  EXPECT_GT(size, 0.05 * std::sqrt(static_cast<double>(end)));
  EXPECT_LT(left.norm(), 0.1 * size);
  EXPECT_NEAR(without.norm(), size, 0.1 * size);
}

TEST_F(SimulatedGears, AFitFindsTheElasticity) {
  const std::string motion = waves("motion.csv", 12, 0.6, 0.5);
  const std::string rows = "effect joint_elasticity joint=1 c=";
  const std::string plant = arm("elastic.robot", kSlight, rows + "5e-5\n");
  const Outcome run = simulate(
      plant, motion, "--controller ff --encoder 2e-6 --encoder-noise 1 --torque-noise 0.02");
  ASSERT_EQ(run.exit_code, 0) << run.out;
  const std::string open = arm("open.robot", kSlight, rows + "*\n");
  const Outcome fit =
      dynid("fit " + open + " " + path("run.csv") + " -o " + path("identified.robot"));
  ASSERT_EQ(fit.exit_code, 0) << fit.out;
  const std::string text = content(path("identified.robot"));
  const std::size_t at = text.find(" c=");
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_NEAR(std::stod(text.substr(at + 3)), 5e-5, 0.05 * 5e-5) << fit.out;
}

TEST_F(SimulatedGears, SaysWhatCannotTwist) {
  const std::string motion = waves("waves.csv", 0.5, 0.2, 0.5);
  const auto refused = [&](const std::string& row, const std::string& rotors,
                           const std::string& words) {
    const Outcome run =
        simulate(arm("wrong.robot", kDry, "effect " + row + "\n", rotors), motion, "");
    EXPECT_EQ(run.exit_code, 1) << run.out;
    EXPECT_NE(run.out.find(words), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("wrong.robot:"), std::string::npos) << run.out;
  };
  refused("joint_elasticity joint=2 c=1e-4", "0.5 0", "'IA' of joint 2 is 0");
  refused("backlash joint=1 gap=0.002 t0=1", "0 0.3", "'IA' of joint 1 is 0");
  refused("joint_elasticity_cubic joint=1 c=0 c3=1e-9", "0.5 0.3",
          "under a small load the gear twists by 0");
}

TEST_F(SimulatedGears, SaysWhatASmallRotorNeeds) {
  const std::string motion = waves("waves.csv", 0.5, 0.2, 0.5);
  const std::string robot =
      arm("small.robot", kDry, "effect joint_elasticity joint=1 c=1e-4\n", "0.01 0.3");
  const std::string options = "--controller pd --bandwidth 4 --saturate off --rate ";
  const Outcome slow = simulate(robot, motion, options + "1000");
  EXPECT_EQ(slow.exit_code, 3) << slow.out;
  EXPECT_NE(slow.out.find("meets its rotor alone"), std::string::npos) << slow.out;
  const Outcome fast = simulate(robot, motion, options + "20000");
  EXPECT_EQ(fast.exit_code, 0) << fast.out;
}

TEST_F(SimulatedGears, AGearThatIsStiffOrDoesNotTwistIsRigid) {
  const std::string motion = waves("waves.csv", 0.5, 0.2, 0.5);
  ASSERT_EQ(simulate(arm("rigid.robot", kDry, ""), motion, "").exit_code, 0);
  const std::string rigid = content(path("run.csv"));
  const Outcome stiff =
      simulate(arm("stiff.robot", kDry, "effect joint_elasticity joint=1 c=1e-10\n"), motion, "");
  ASSERT_EQ(stiff.exit_code, 0) << stiff.out;
  EXPECT_NE(stiff.out.find("the gear of joint 1 is rigid in the simulation"), std::string::npos);
  EXPECT_EQ(content(path("run.csv")), rigid);
  const Outcome none =
      simulate(arm("none.robot", kDry, "effect joint_elasticity joint=1 c=0\n"), motion, "");
  ASSERT_EQ(none.exit_code, 0) << none.out;
  EXPECT_EQ(content(path("run.csv")), rigid);
}

}  // namespace
}  // namespace dyngen::runtime
