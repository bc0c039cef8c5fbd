// SPDX-License-Identifier: MIT
// What dynid writes dyngen reads, and it leaves the residual that the fit printed.
#include "tests/runtime/dynid/round_trip.h"

#include <gtest/gtest.h>

#include "gen/robot_input/robot_input.h"
#include "runtime/recordings/gzip.h"
#include "tests/runtime/dynid/diagnosis_schema.h"
#include "tests/runtime/dynid/random_robot_text.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Json = nlohmann::json;
using test::content;
using test::dynid;
using test::Outcome;
using test::RoundTrip;

/// Some of the random robots, in parts that each end in time.
struct RobotBatch {
  int first = 0, count = 0;
};

std::string batch_name(const testing::TestParamInfo<RobotBatch>& entry) {
  return "From" + std::to_string(entry.param.first);
}

/// The robots of a batch in which something is left open.
template <typename Visit>
void visit_robots(const RobotBatch& batch, const Visit& visit) {
  int place = 0;
  for (std::uint64_t seed = 1; place < batch.first + batch.count; ++seed) {
    const std::string text = test::random_robot_text(seed);
    const DescribedRobot robot =
        describe_robot(parse_robot_file(text, "arm.robot"), OpenParameters::kAbsentRows);
    if (robot.linear.size() == 0) continue;
    if (place++ >= batch.first) visit(seed, text, robot);
    if (testing::Test::HasFatalFailure()) return;
  }
}

class RoundTripOfRandomRobots : public RoundTrip, public testing::WithParamInterface<RobotBatch> {
 protected:
  void fit_and_check(std::uint64_t seed, const std::string& text, const DescribedRobot& robot) {
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text);
    VectorXd beta = test::plausible_beta(robot.linear, seed);
    if (seed % 2 == 0) beta = -beta;  // what a turned sign makes of inertia and friction
    const std::string recording = record(
        "run.csv", robot, beta,
        {.seconds = 4, .sample_time = 0.004, .period = 4, .torque_noise = 0.05, .seed = seed});
    const std::string file = written("arm.robot", text);
    ASSERT_EQ(go_round(file, recording), "") << content(path("id.robot"));
    expect_torque_of_the_fit(robot);
    if (HasFatalFailure() || !has_numbers(robot)) return;
    const DescribedRobot rest =
        describe_robot(file, OpenParameters::kAbsentRows, {.hold = {"all"}});
    if (rest.linear.size() == 0) return;
    ++held_;
    ASSERT_EQ(go_round(file, recording, "--hold all"), "") << content(path("id.robot"));
    expect_torque_of_the_fit(rest);
  }

  void expect_torque_of_the_fit(const DescribedRobot& robot) const {
    const Json parameters = json("fit.json")["parameters"];
    ASSERT_EQ(parameters.size(), static_cast<std::size_t>(robot.linear.size()));
    VectorXd beta(robot.linear.size());
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      beta[static_cast<Index>(i)] = parameters[i]["value"];
    }
    ASSERT_LT(test::judged_difference(content(path("id.robot")), robot.linear, beta), 1e-9)
        << content(path("id.robot"));
  }

  static bool has_numbers(const DescribedRobot& robot) {
    return (robot.standard.array().isFinite() && robot.standard.array() != 0).any();
  }

  void diagnose_and_check(std::uint64_t seed, const std::string& text,
                          const DescribedRobot& robot) {
    SCOPED_TRACE("seed " + std::to_string(seed) + "\n" + text);
    const std::string recording = record(
        "run.csv", robot, test::bodily_beta(robot, seed),
        {.seconds = 8, .sample_time = 0.01, .period = 4, .torque_noise = 0.05, .seed = seed});
    const Outcome run =
        dynid("diagnose " + written("arm.robot", text) + " " + recording + " --as-recorded" +
              " --json " + path("d.json") + " -o " + path("d.robot"));
    ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 3) << run.out;
    if (run.exit_code == 3) return;  // motion that is too poor: no file is written
    ++through_;
    VectorXd beta(robot.linear.size());
    const Json parameters = json("d.json")["base_parameters"];
    ASSERT_EQ(parameters.size(), static_cast<std::size_t>(beta.size()));
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      beta[static_cast<Index>(i)] = parameters[i]["after"];
    }
    ASSERT_LT(test::judged_difference(content(path("d.robot")), robot.linear, beta), 1e-9)
        << content(path("d.robot"));
    const Outcome check = dynid("check " + path("d.robot") + " " + recording + " --as-recorded");
    ASSERT_EQ(check.exit_code, 0) << check.out;
  }

  int through_ = 0;  ///< robots whose diagnosis wrote a file
  int held_ = 0;     ///< robots with numbers that a second fit held
};

class FitRoundTrip : public RoundTripOfRandomRobots {};

TEST_P(FitRoundTrip, LeavesTheResidualOfTheFit) {
  visit_robots(GetParam(), [&](std::uint64_t seed, const std::string& text,
                               const DescribedRobot& robot) { fit_and_check(seed, text, robot); });
  EXPECT_GT(held_, 0);
  RecordProperty("held", held_);
}

// 200 in all: those after the first batch are slow
INSTANTIATE_TEST_SUITE_P(Some, FitRoundTrip, testing::Values(RobotBatch{0, 20}), batch_name);
INSTANTIATE_TEST_SUITE_P(More, FitRoundTrip,
                         testing::Values(RobotBatch{20, 60}, RobotBatch{80, 60},
                                         RobotBatch{140, 60}),
                         batch_name);

class DiagnoseRoundTrip : public RoundTripOfRandomRobots {};

TEST_P(DiagnoseRoundTrip, WritesTheParametersThatItFound) {
  visit_robots(GetParam(),
               [&](std::uint64_t seed, const std::string& text, const DescribedRobot& robot) {
                 diagnose_and_check(seed, text, robot);
               });
  EXPECT_GE(2 * through_, GetParam().count);
  RecordProperty("through", through_);
}

INSTANTIATE_TEST_SUITE_P(Some, DiagnoseRoundTrip, testing::Values(RobotBatch{0, 3}), batch_name);
INSTANTIATE_TEST_SUITE_P(More, DiagnoseRoundTrip,
                         testing::Values(RobotBatch{3, 17}, RobotBatch{20, 20}, RobotBatch{40, 20},
                                         RobotBatch{60, 20}, RobotBatch{80, 20},
                                         RobotBatch{100, 20}, RobotBatch{120, 20},
                                         RobotBatch{140, 20}, RobotBatch{160, 20},
                                         RobotBatch{180, 20}),
                         batch_name);

TEST_F(RoundTrip, StandardDhArmWithAnElbow) {
  if (!gzip_available()) GTEST_SKIP() << "built without zlib";
  const std::string folder = DYNGEN_SOURCE_DIR "/tests/data/cases/standard_dh/";
  EXPECT_EQ(go_round(folder + "ur5std.robot", folder + "run.csv.gz"), "");
  const RobotFile file = read_robot_file(path("id.robot"));
  EXPECT_EQ(file.parameters, ParameterMeaning::kBase);
}

TEST_F(RoundTrip, EffectsSeeTheLoadThatTheFitSaw) {
  // rotors that are known, and that base parameters join with the links
  std::string text = content(DYNGEN_SOURCE_DIR "/tests/studies/robots/puma3.robot");
  const std::size_t row = text.find("\nIA ");
  text.replace(row, text.find('\n', row + 1) - row, "\nIA 0.7 0.5 0.2");
  text.insert(text.rfind("stop"), "effect load_friction joint=2\neffect stribeck joint=1\n");
  const std::string robot = written("geared.robot", text);
  const DescribedRobot described = describe_robot(robot, OpenParameters::kAbsentRows);
  const std::string recording = record(
      "run.csv", described, test::plausible_beta(described.linear, 4), {.torque_noise = 0.3});
  EXPECT_EQ(go_round(robot, recording), "") << content(path("id.robot"));
}

/// Arms whose fit is apt to end in negative rotor inertia, mass or friction: these parameters are
/// open, and the robot has none of them.
std::string bare_robot(int kind) {
  switch (kind % 5) {
    case 0:  // planar, upright
      return "number_link 2\nsigma 0 0\nal pi/2 0\nd 0 0.5\nth 0 0\nr 0 0\nIA * *\ngz 9.81\nstop\n";
    case 1:  // gantry
      return "number_link 2\nsigma 1 1\nal 0 pi/2\nd 0 0\nth 0 0\nr 0 0\ngz 9.81\nstop\n";
    case 2:
      return "number_link 2\ndh standard\nsigma 0 0\nal pi/2 0\nd 0 0.4\nth 0 0\nr 0.1 0\n"
             "gz 9.81\nstop\n";
    case 3:  // shoulder and elbow
      return "number_link 3\nsigma 0 0 0\nal 0 -pi/2 0\nd 0 0 0.45\nth 0 0 0\nr 0.4 0 0\n"
             "gz 9.81\nstop\n";
    default:  // SCARA
      return "number_link 3\nsigma 0 0 1\nal 0 0 0\nd 0 0.3 0.25\nth 0 0 0\nr 0 0 0\n"
             "gz 9.81\nstop\n";
  }
}

class DiagnoseAnswers : public RoundTrip, public testing::WithParamInterface<RobotBatch> {
 protected:
  /// @param seed  a third of the robots lack rotors, a third friction, a third both
  void expect_answer(std::uint64_t seed) const {
    const std::string robot = written("arm.robot", bare_robot(static_cast<int>(seed)));
    const DescribedRobot described = describe_robot(robot, OpenParameters::kAbsentRows);
    VectorXd standard = test::bodily_standard(described, seed);
    for (Index i = 0; i < standard.size(); ++i) {
      const Chi kind = static_cast<Chi>(i % static_cast<Index>(kChiCount));
      const bool friction = kind == Chi::kFS || kind == Chi::kFV;
      if ((kind == Chi::kIA && seed % 3 != 1) || (friction && seed % 3 != 2)) standard[i] = 0;
    }
    const std::string recording =
        record("run.csv", described, described.grouping * standard,
               {.seconds = 12, .sample_time = 0.01, .torque_noise = 0.1, .seed = seed});
    const Outcome run = dynid("diagnose " + robot + " " + recording + " --json " + path("d.json") +
                              " --report " + path("d.html") + " -o " + path("d.robot"));
    ASSERT_EQ(run.exit_code, 0) << run.out;
    EXPECT_EQ(test::schema_faults(json("d.json")), std::vector<std::string>{});
    EXPECT_EQ(test::page_fault(content(path("d.html"))), "");
    const Outcome check = dynid("check " + path("d.robot") + " " + recording);
    EXPECT_EQ(check.exit_code, 0) << check.out;
  }
};

TEST_P(DiagnoseAnswers, WhereRotorsOrFrictionAreNotThere) {
  for (int seed = GetParam().first + 1; seed <= GetParam().first + GetParam().count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_answer(static_cast<std::uint64_t>(seed));
    if (HasFatalFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(Some, DiagnoseAnswers, testing::Values(RobotBatch{0, 5}), batch_name);
INSTANTIATE_TEST_SUITE_P(More, DiagnoseAnswers,
                         testing::Values(RobotBatch{5, 15}, RobotBatch{20, 20}, RobotBatch{40, 20},
                                         RobotBatch{60, 20}, RobotBatch{80, 20}),
                         batch_name);

}  // namespace
}  // namespace dyngen::runtime
