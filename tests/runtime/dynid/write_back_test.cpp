// SPDX-License-Identifier: MIT
// Identified numbers in URDF and MJCF: the torque is the identified robot's, all else is as it was.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "gen/robot_input/robot_input.h"
#include "gen/robot_output/robot_tree.h"
#include "runtime/tools/dynid/effects/effect_laws.h"
#include "runtime/tools/dynid/robot/description_bodies.h"
#include "runtime/tools/dynid/robot/identified_description.h"
#include "runtime/tools/dynid/robot/identified_file.h"
#include "runtime/tools/dynid/robot/left_out_json.h"
#include "tests/gen/robot_input/description_text.h"
#include "tests/runtime/dynid/identified_robot.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using test::identified_base_parameters;
using test::into;
using test::MadeLink;
using test::with_other_bodies;
using test::written;

/// Torques without dry friction, by plain Newton and Euler over the links that a description names.
void expect_torques(const std::string& text, const std::vector<MadeLink>& links) {
  test::NumericRobot robot = test::numeric_robot(build_model(parse_robot(text, "w.urdf")));
  for (test::NumericJoint& joint : robot.joints) joint.Fs = 0;
  const RobotModel model = build_model(parse_robot(text, "w.urdf"));
  const std::vector<int> order = test::depth_first(links);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int sample = 0; sample < 3; ++sample) {
    std::vector<double> q(order.size()), dq(q), ddq(q);
    for (auto* values : {&q, &dq, &ddq}) {
      for (double& value : *values) value = number(random);
    }
    const std::vector<double> expected = test::torques_of(links, q, dq, ddq);
    std::vector<double> all_q(robot.size()), all_dq(all_q), all_ddq(all_q);
    for (std::size_t j = 0; j < robot.size(); ++j) {
      const int c = model.joints[j].coordinate;
      if (c < 0) continue;
      const auto place = static_cast<std::size_t>(order[static_cast<std::size_t>(c)]);
      all_q[j] = q[place];
      all_dq[j] = dq[place];
      all_ddq[j] = ddq[place];
    }
    const std::vector<double> found = test::id(robot, all_q, all_dq, all_ddq);
    double size = 0;
    for (const double value : expected) size = std::max(size, std::fabs(value));
    for (std::size_t j = 0; j < robot.size(); ++j) {
      const int c = model.joints[j].coordinate;
      if (c < 0) continue;
      const auto place = static_cast<std::size_t>(order[static_cast<std::size_t>(c)]);
      EXPECT_NEAR(found[j], expected[place], 1e-9 * size) << "joint " << c + 1;
    }
  }
}

/// A description without what may change.
std::string frame_of_text(const std::string& text) {
  std::string rest = std::regex_replace(text, std::regex("<inertial[^]*?</inertial>"), "");
  rest = std::regex_replace(rest, std::regex("<dynamics[^>]*>"), "");
  return std::regex_replace(rest, std::regex("\n  <!--[^]*?-->"), "");
}

TEST(WriteBack, UrdfHasTheTorqueOfTheFit) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<MadeLink> links = test::made_robot(seed);
    const std::vector<MadeLink> nominal = with_other_bodies(links, seed);
    const std::string before = urdf_of(nominal);
    const std::string path = written(test::temporary_path("nominal.urdf"), before);
    IdentifiedDescription result;
    ASSERT_NO_THROW(result = into(path, identified_base_parameters(links)));
    EXPECT_TRUE(result.left_out.empty());
    EXPECT_NE(result.text, before);
    EXPECT_EQ(frame_of_text(result.text), frame_of_text(before));
    EXPECT_NE(result.text.find("fitted - - by a test"), std::string::npos);
    expect_torques(result.text, links);
    if (HasFailure()) return;
  }
}

std::vector<std::size_t> moving_links(const std::vector<MadeLink>& links) {
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].parent >= 0 && links[i].type != 2) moving.push_back(i);
  }
  return moving;
}

/// Friction that is 0 in the description of one joint and not of others.
TEST(WriteBack, AZeroOfTheDescriptionIsNoKnowledge) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<MadeLink> links = test::made_robot(seed);
    std::vector<MadeLink> nominal = with_other_bodies(links, seed);
    const std::vector<std::size_t> moving = moving_links(links);
    nominal[moving.front()].damping = 0;
    nominal[moving.back()].friction = 0;
    const std::string path = written(test::temporary_path("zeros.urdf"), urdf_of(nominal));
    IdentifiedDescription result;
    ASSERT_NO_THROW(result = into(path, identified_base_parameters(links)));
    expect_torques(result.text, links);
  }
}

/// A fit estimates the bodies of links that have none in the description, and zeros of friction.
TEST(WriteBack, WhatIsMissingInTheDescriptionIsEstimated) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<MadeLink> links = test::made_robot(seed);
    std::vector<MadeLink> bare = links;
    for (const std::size_t moving : moving_links(links)) {
      bare[moving].mass = bare[moving].damping = 0;
      bare[moving].inertia.setZero();
    }
    for (const OpenParameters open : {OpenParameters::kAbsentRows, OpenParameters::kEverything}) {
      const auto parameters = [&](const std::vector<MadeLink>& of) {
        return describe_robot(parse_robot(urdf_of(of), "arm.urdf"), open).linear.size();
      };
      EXPECT_EQ(parameters(bare), parameters(links));
    }
  }
}

TEST(WriteBack, OfItsOwnNumbersChangesNothing) {
  const std::vector<MadeLink> links = test::made_robot(4);
  const std::string before = urdf_of(links);
  const std::string path = written(test::temporary_path("own.urdf"), before);
  WriteBackTask task;
  task.description = RobotSource(path);
  const std::string same = parse_robot(before, path).text;
  EXPECT_EQ(identified_description(same, "own.robot", task, effect_catalogue({})).text, before);
}

TEST(WriteBack, AnotherArmIsRefused) {
  // of some robots no torque tells the lengths, such as those with one joint
  int refused = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    std::vector<MadeLink> longer = test::made_robot(seed);
    const std::string path = written(test::temporary_path("other.urdf"), urdf_of(longer));
    for (MadeLink& link : longer) link.xyz *= 1.1;
    try {
      into(path, identified_base_parameters(longer));
    } catch (const ModelError&) {
      ++refused;
    }
  }
  EXPECT_GE(refused, 5);
}

TEST(WriteBack, NegativeMassesHaveNoBodies) {
  std::vector<MadeLink> links = test::made_robot(5);
  const std::string path = written(test::temporary_path("negative.urdf"), urdf_of(links));
  for (MadeLink& link : links) link.inertia *= -1, link.mass *= -1;
  EXPECT_THROW(into(path, identified_base_parameters(links)), NoBodiesError);
}

constexpr const char* kPendulum = R"(<mujoco>
  <compiler angle="degree"/>
  <worldbody>
    <body name="arm">  <!-- stays -->
      <joint name="swing" type="hinge" axis="0 1 0" damping="0.1"/>
      <inertial pos="0.2 0 0" mass="2" diaginertia="0.01 0.05 0.05"/>
    </body>
  </worldbody>
  <actuator>
    <motor name="m" joint="swing" gear="50"/>
  </actuator>
</mujoco>
)";

/// What dynid diagnose writes of the pendulum with such rows.
std::string pendulum_with(const std::vector<std::string>& rows, const std::string& path) {
  std::string text = parse_robot(kPendulum, path).text;
  const std::size_t stop = text.rfind("stop");
  for (const std::string& row : rows) text.insert(stop, row + "\n");
  return text;
}

TEST(WriteBack, FindingsBecomeFieldsOfMujoco) {
  const std::string path = written(test::temporary_path("pendulum.xml"), kPendulum);
  const std::string text = into(path, pendulum_with({"effect linear_spring joint=1 k=4 c=-2",
                                                     "effect joint_torque_gain joint=1 gain=0.25",
                                                     "effect actuator_lag joint=1 T=0.004"},
                                                    path))
                               .text;
  EXPECT_NE(text.find("stiffness=\"4\""), std::string::npos) << text;
  // k q + c is 0 at 0.5 rad, which this file writes in degrees
  std::smatch reference;
  ASSERT_TRUE(std::regex_search(text, reference, std::regex("springref=\"([^\"]*)\""))) << text;
  EXPECT_NEAR(std::stod(reference[1]), 0.5 * 180 / 3.14159265358979323846, 1e-9);
  EXPECT_NE(text.find("<general name=\"m\" joint=\"swing\" gear=\"40\" dyntype=\"filter\" "
                      "dynprm=\"0.004\"/>"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("<!-- stays -->"), std::string::npos);
}

TEST(WriteBack, WhatHasNoFieldIsNamed) {
  const std::string path = written(test::temporary_path("named.xml"), kPendulum);
  const IdentifiedDescription result =
      into(path, pendulum_with({"effect stribeck joint=1 Fs=2 vs=0.05 delta=2"}, path));
  ASSERT_EQ(result.left_out.size(), 1U);
  EXPECT_EQ(result.left_out[0].what, "stribeck of swing");
  EXPECT_NE(result.text.find("stribeck of swing"), std::string::npos);
  const Json json = written_back_json({"out.xml", path, result});
  EXPECT_EQ(json["form"], "MJCF");
  EXPECT_EQ(json["file"], "out.xml");
  EXPECT_EQ(json["of"], path);
  ASSERT_EQ(json["left_out"].size(), 1U);
  EXPECT_EQ(json["left_out"][0]["what"], "stribeck of swing");
  EXPECT_EQ(json["left_out"][0]["reason"], "MuJoCo has no field for it");
  EXPECT_TRUE(json["left_out"][0]["rms"].is_null());
}

}  // namespace
}  // namespace dyngen::runtime
