// SPDX-License-Identifier: MIT
// --eval: how a state is read, and its numbers against the judge.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "gen/evaluate/evaluation_text.h"
#include "gen/evaluate/robot_numbers.h"
#include "gen/robot_input/robot_input.h"
#include "tests/support/body_robots.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/relative_error.h"

namespace dyngen::test::evaluation_tests {
namespace {

using testing::HasSubstr;

const char* const kArm =
    "name arm\nnumber_link 3\nsigma 0 2 1\nal 0 pi/2 0\nd 0 0.5 0\nr 0 0 0.1\nm 2 3 1\n"
    "mX 0.4 0.6 0.1\nZZ 0.1 0.2 0.3\nIA 0.5 0 0.25\nFv 1 0 2\nFs 3 0 4\noff 0.5 0 -0.5\n"
    "qmin -1 0 -0.5\nqmax 1 0 0.5\nvmax 2 1 2\namax 5 1 5\ntaumax 20 1 100\n"
    "joints waist plate slide\ngz 9.81\nstop\n";

std::string message_of(const std::vector<std::string>& words, const RobotModel& model) {
  try {
    read_state(words, model);
    return "";
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(StateWords, TakeExpressionsInOneWordOrSeveral) {
  const RobotModel model = parse_model(kArm);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"q=pi/2,-30*deg", "dq=1,2", "ddq=sqrt(4),1e-1"},
        std::vector<std::string>{"q = pi/2 , -30*deg dq=1,2 ddq=sqrt(4) 1e-1"}}) {
    const StateRequest state = read_state(words, model);
    EXPECT_THAT(state.q, testing::ElementsAre(testing::DoubleEq(std::numbers::pi / 2),
                                              testing::DoubleEq(-std::numbers::pi / 6)));
    EXPECT_THAT(state.dq, testing::ElementsAre(1.0, 2.0));
    EXPECT_THAT(state.ddq, testing::ElementsAre(2.0, 0.1));
  }
  const StateRequest rest = read_state({"q=0,0"}, model);
  EXPECT_THAT(rest.dq, testing::ElementsAre(0.0, 0.0));
  EXPECT_THAT(rest.ddq, testing::ElementsAre(0.0, 0.0));
}

TEST(StateWords, RefuseWhatIsWrongByPlace) {
  const RobotModel model = parse_model(kArm);
  EXPECT_THAT(message_of({"q=1"}, model), HasSubstr("--eval:1:1: error: 'q' has 1 value"));
  EXPECT_THAT(message_of({"q=1"}, model),
              HasSubstr("one for each moving joint of arm: waist slide"));
  EXPECT_THAT(message_of({"q=1,2,3"}, model), HasSubstr("'q' has 3 values"));
  EXPECT_THAT(message_of({"q=1,2", "dq=1"}, model),
              HasSubstr("--eval:1:7: error: 'dq' has 1 value"));
  EXPECT_THAT(message_of({"q=1,foo"}, model), HasSubstr("--eval:1:5: error: unknown"));
  EXPECT_THAT(message_of({"q=1,2", "q=1,2"}, model), HasSubstr("'q' stands twice"));
  EXPECT_THAT(message_of({"1,2"}, model), HasSubstr("belongs to no name"));
  EXPECT_THAT(message_of({"dq=1,2"}, model), HasSubstr("q is missing"));
  EXPECT_THAT(message_of({"q=1/0,2"}, model), HasSubstr("--eval:1:"));
  EXPECT_THAT(message_of({"q=1,2", "XX2="}, model), HasSubstr("'XX2' has 0 values"));
  EXPECT_THAT(message_of({"q=*,2"}, model), HasSubstr("--eval:1:3: error"));
}

TEST(RobotNumbers, EqualTheJudge) {
  for (const NamedRobot& named : robots_of_files()) {
    const RobotModel model = robot_model(named.robot);
    RobotNumbers robot(model, {});
    for (const MotionSample& sample : random_samples(model.coordinate_count, 3, 5)) {
      const MotionArrays motion = {1, sample.q, sample.dq, sample.ddq};
      for (const char* function : {"id", "gravity", "coriolis", "mass_matrix"}) {
        RelativeError error;
        error.add(1.0, 1.0);
        error.add(robot.run(function, motion), judge(model, named.robot, function, sample));
        EXPECT_LT(error.value(), 1e-10) << named.name << " " << function;
      }
    }
  }
}

TEST(RobotNumbers, TakeGivenNumbersForUnknownOnesAlone) {
  const std::string text = kArm;
  std::string open = text;
  open.replace(open.find("mX 0.4 0.6 0.1"), 14, "mX * 0.6 0.1  ");
  open.replace(open.find("d 0 0.5 0"), 9, "d 0 *   0");
  const RobotModel model = parse_model(open);
  try {
    RobotNumbers(model, {});
    FAIL() << "accepted";
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("test.robot: error: MX1, d2 are unknown"));
  }
  const StateRequest state = read_state({"q=0.1,0.2 mX1=2/5 d2=0.5"}, model);
  RobotNumbers given(model, {}, state.given), whole(parse_model(text), {});
  const MotionArrays motion = {1, state.q, {1, 2}, {3, 4}};
  EXPECT_EQ(given.run("id", motion), whole.run("id", motion));

  for (const char* wrong : {"XX9=1", "ZZ1=1", "foo=2"}) {
    EXPECT_THROW(RobotNumbers(model, {}, read_state({"q=0,0", wrong}, model).given), ModelError)
        << wrong;
  }
}

/// The numbers of the row behind a label, of the first block of joints.
std::vector<double> row_of(const std::string& text, const std::string& label) {
  std::istringstream lines(text);
  std::vector<double> values;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(label) || line.size() < 14 || line[label.size()] != ' ') continue;
    std::istringstream numbers(line.substr(14));
    for (double value; numbers >> value;) values.push_back(value);
    break;
  }
  return values;
}

TEST(EvaluationText, PartsAddUpToTheTorqueAndFitTheTerminal) {
  const RobotFile file = parse_robot_file(kArm, "arm.robot");
  const RobotModel model = build_model(file);
  RobotNumbers robot(model, {});
  const StateRequest state = read_state({"q=0.3,0.2 dq=-1,0.5 ddq=2,-3"}, model);
  const std::string text = evaluation_text(robot, file, state);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;

  const std::vector<double> torque = row_of(text, "torque");
  ASSERT_EQ(torque.size(), 2U) << text;
  MotionSample sample;
  sample.q = state.q;
  sample.dq = state.dq;
  sample.ddq = state.ddq;
  const std::vector<double> expected = judge(model, numeric_robot(model), "id", sample);
  std::vector<double> sum(2, 0.0);
  for (const char* part :
       {"rigid inertia", "Coriolis", "gravity", "rotor inertia", "viscous", "Coulomb", "offset"}) {
    const std::vector<double> values = row_of(text, part);
    ASSERT_EQ(values.size(), 2U) << part << "\n" << text;
    for (std::size_t i = 0; i < 2; ++i) sum[i] += values[i];
  }
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(torque[i], expected[i], 1e-4);
    EXPECT_NEAR(sum[i], expected[i], 1e-4);
  }
  EXPECT_THAT(row_of(text, "viscous"), testing::ElementsAre(-1.0, 1.0));
  EXPECT_THAT(row_of(text, "Coulomb"), testing::ElementsAre(-3.0, 4.0));
  EXPECT_THAT(row_of(text, "rotor inertia"), testing::ElementsAre(1.0, -0.75));
  EXPECT_THAT(row_of(text, "offset"), testing::ElementsAre(0.5, -0.5));
  EXPECT_THAT(text, HasSubstr("3 slide"));
  EXPECT_THAT(text, testing::Not(HasSubstr("Beyond the limits")));
}

TEST(EvaluationText, SaysWhatIsBeyondTheLimits) {
  const RobotFile file = parse_robot_file(kArm, "arm.robot");
  const RobotModel model = build_model(file);
  RobotNumbers robot(model, {});
  const std::string text =
      evaluation_text(robot, file, read_state({"q=-1.5,0.7 dq=3,0 ddq=0,50"}, model));
  EXPECT_THAT(text, HasSubstr("joint 1 waist: q = -1.5 is below qmin = -1"));
  EXPECT_THAT(text, HasSubstr("joint 3 slide: q = 0.7 is above qmax = 0.5"));
  EXPECT_THAT(text, HasSubstr("joint 1 waist: |dq| = 3 is above vmax = 2"));
  EXPECT_THAT(text, HasSubstr("joint 3 slide: |ddq| = 50 is above amax = 5"));
}

TEST(EvaluationText, PosesAreTheJudgesAndAnglesTurnThere) {
  for (const char* path : {"robots/puma560.robot", "tests/robots/puma560_corke_std.robot"}) {
    const RobotFile file = read_robot_file(std::string(DYNGEN_SOURCE_DIR "/") + path);
    const RobotModel model = build_model(file);
    RobotNumbers robot(with_random_values(model, 3), {});
    const StateRequest state = read_state({"q=0.1,0.2,0.3,-0.4,0.5,2.6"}, model);
    const std::string text = evaluation_text(robot, file, state);
    const std::vector<Transform<double>> frames =
        forward_kinematics(numeric_robot(with_random_values(model, 3)), state.q);
    for (int j = 1; j <= model.size(); ++j) {
      const std::vector<double> row =
          row_of(text, fmt::format("{} {}", j, model.joint(j).name).substr(0, 13));
      ASSERT_EQ(row.size(), 6U) << text;
      const auto& T = frames[static_cast<std::size_t>(j - 1)];
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(row[static_cast<std::size_t>(k)], T(k, 3), 1e-6);
      }
      const double roll = row[3], pitch = row[4], yaw = row[5];
      EXPECT_NEAR(std::cos(yaw) * std::cos(pitch), T(0, 0), 3e-6);
      EXPECT_NEAR(std::sin(yaw) * std::cos(pitch), T(1, 0), 3e-6);
      EXPECT_NEAR(-std::sin(pitch), T(2, 0), 3e-6);
      EXPECT_NEAR(std::cos(pitch) * std::sin(roll), T(2, 1), 3e-6);
      EXPECT_NEAR(std::cos(pitch) * std::cos(roll), T(2, 2), 3e-6);
    }
  }
}

}  // namespace
}  // namespace dyngen::test::evaluation_tests
