// SPDX-License-Identifier: MIT
// --compare: what is the same is said to be, and what differs is found by its name.
#include "gen/compare/comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <sstream>

#include "gen/robot_input/robot_input.h"
#include "tests/support/body_robots.h"
#include "tests/support/model_bridge.h"

namespace dyngen::test::comparison_tests {
namespace {

using testing::HasSubstr;

ComparedRobot file_robot(const std::string& path) {
  ComparedRobot robot;
  robot.file = read_robot_file(std::string(DYNGEN_SOURCE_DIR "/") + path);
  robot.model = with_random_values(build_model(robot.file), 3);
  return robot;
}

ComparedRobot changed(ComparedRobot robot, const std::function<void(RobotModel&)>& change) {
  change(robot.model);
  return robot;
}

const PartDifference& part(const Comparison& comparison, const std::string& name) {
  for (const PartDifference& entry : comparison.parts) {
    if (entry.part == name) return entry;
  }
  throw std::runtime_error("no part " + name);
}

TEST(Comparison, OfARobotWithItselfFindsNothing) {
  for (const char* path : {"robots/puma560.robot", "robots/scara.robot", "robots/planar2r.robot"}) {
    const ComparedRobot robot = file_robot(path);
    const Comparison comparison = compare_robots(robot, robot);
    EXPECT_TRUE(comparison.same_torques && comparison.same_axes && comparison.same_frame) << path;
    EXPECT_THAT(comparison_text(robot, robot, comparison),
                HasSubstr("The two are the same to 1e-10"));
  }
}

/// A fixed joint more at the tip, and mass that moves over to it: the same arm.
TEST(Comparison, OfTheSameArmInOtherFramesFindsNothing) {
  ComparedRobot one, other;
  one.file = parse_robot_file(
      "number_link 2\nsigma 0 0\nal 0 pi/2\nd 0 0.5\nm 2 3\nmX 0.4 0.6\nZZ 0.1 0.2\nYY 0 0.3\n"
      "gz 9.81\nstop\n",
      "one.robot");
  other.file = parse_robot_file(
      "number_link 3\nsigma 0 0 2\nal 0 pi/2 0\nd 0 0.5 0\nm 2 0 3\nmX 0.4 0 0.6\nZZ 0.1 0 0.2\n"
      "YY 0 0 0.3\ngz 9.81\nstop\n",
      "other.robot");
  one.model = build_model(one.file);
  other.model = build_model(other.file);
  const Comparison comparison = compare_robots(one, other);
  EXPECT_TRUE(comparison.same_torques);
  EXPECT_TRUE(comparison.same_axes);
  EXPECT_TRUE(comparison.same_frame);
}

TEST(Comparison, NamesThePartThatDiffers) {
  const ComparedRobot robot = file_robot("robots/puma560.robot");
  const Comparison friction = compare_robots(robot, changed(robot, [](RobotModel& model) {
                                               model.joints[2].chi[index(Chi::kFV)].value += 1;
                                             }));
  EXPECT_FALSE(friction.same_torques);
  EXPECT_FALSE(part(friction, "friction").same);
  EXPECT_EQ(part(friction, "friction").joint, 2);
  EXPECT_TRUE(part(friction, "gravity").same);
  EXPECT_TRUE(part(friction, "mass matrix").same);
  EXPECT_TRUE(friction.same_axes);

  const Comparison gravity =
      compare_robots(robot, changed(robot, [](RobotModel& model) { model.gravity[2].value = 9; }));
  EXPECT_FALSE(part(gravity, "gravity").same);
  EXPECT_TRUE(part(gravity, "mass matrix").same);
  EXPECT_TRUE(part(gravity, "friction").same);

  const Comparison rotor = compare_robots(robot, changed(robot, [](RobotModel& model) {
                                            model.joints[4].chi[index(Chi::kIA)].value +=
                                                GiNaC::numeric(1, 10);
                                          }));
  EXPECT_FALSE(part(rotor, "mass matrix").same);
  EXPECT_EQ(part(rotor, "mass matrix").joint, 4);
  EXPECT_TRUE(part(rotor, "Coriolis").same);
  EXPECT_TRUE(part(rotor, "gravity").same);
  EXPECT_TRUE(rotor.same_frame);
}

TEST(Comparison, FindsOtherGeometryAndTheStateOfTheWorstTorque) {
  const ComparedRobot robot = file_robot("robots/puma560.robot");
  const ComparedRobot longer =
      changed(robot, [](RobotModel& model) { model.joints[2].d.value += GiNaC::numeric(1, 1000); });
  const Comparison comparison = compare_robots(robot, longer);
  EXPECT_FALSE(comparison.same_torques);
  EXPECT_FALSE(comparison.same_axes);
  EXPECT_FALSE(comparison.same_frame);
  EXPECT_NEAR(comparison.frame_distance, 1e-3, 1e-9);
  EXPECT_LT(comparison.axes[1].distance, 1e-12);
  EXPECT_NEAR(comparison.axes[2].distance, 1e-3, 1e-5);
  RobotNumbers a(robot.model, {}), b(longer.model, {});
  const TorqueDifference& worst = comparison.torques[1];
  const MotionArrays motion = {1, worst.q, worst.dq, worst.ddq};
  EXPECT_NEAR(a.run("id", motion)[1], worst.first, 1e-9);
  EXPECT_NEAR(b.run("id", motion)[1], worst.second, 1e-9);
  EXPECT_NEAR(std::abs(worst.first - worst.second), worst.difference, 1e-12);
  const std::string text = comparison_text(robot, longer, comparison);
  EXPECT_THAT(text,
              HasSubstr("The two differ in: torques, joint axes, the frame of the last link."));
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
}

TEST(Comparison, OfOtherJointsIsRefusedByName) {
  const ComparedRobot puma = file_robot("robots/puma560.robot");
  const ComparedRobot planar = file_robot("robots/planar2r.robot");
  const ComparedRobot scara = file_robot("robots/scara.robot");
  EXPECT_THAT(comparison_text(puma, planar, compare_robots(puma, planar)),
              HasSubstr("only the first has the moving joints"));
  const Comparison types = compare_robots(puma, scara);
  ASSERT_FALSE(types.other_joints.empty());
  EXPECT_THAT(comparison_text(puma, scara, types), HasSubstr("is revolute in the first"));
}

TEST(Comparison, StaysWithinTheLimitsOfBothAndIsTheSameEveryTime) {
  ComparedRobot one, other;
  const std::string rows = "number_link 1\nsigma 0\nZZ 1\nmX 1\ngx 9.81\n";
  one.file = parse_robot_file(rows + "qmin -1\nqmax 2\nvmax 3\nstop\n", "one.robot");
  other.file = parse_robot_file(rows + "qmin 0.5\nqmax 4\nvmax 2.5\nstop\n", "other.robot");
  one.model = build_model(one.file);
  other.model = build_model(other.file);
  other.model.joints[0].chi[index(Chi::kMX)].value = 2;
  const Comparison comparison = compare_robots(one, other);
  EXPECT_EQ(comparison.ranges[0].q_min, 0.5);
  EXPECT_EQ(comparison.ranges[0].q_max, 2.0);
  EXPECT_EQ(comparison.ranges[0].dq, 2.5);
  EXPECT_GE(comparison.torques[0].q[0], 0.5);
  EXPECT_LE(comparison.torques[0].q[0], 2.0);
  EXPECT_EQ(comparison.torques[0].q, compare_robots(one, other).torques[0].q);
}

}  // namespace
}  // namespace dyngen::test::comparison_tests
