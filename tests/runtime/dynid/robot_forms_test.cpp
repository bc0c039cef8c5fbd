// SPDX-License-Identifier: MIT
// Robots in other forms as estimation sees them: CAD rows, and URDF with a part that is chosen.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "gen/robot_input/robot_input.h"
#include "runtime/tools/dynid/robot/described_robot.h"
#include "runtime/tools/dynid/robot/identified_file.h"
#include "tests/runtime/dynid/run_dynid.h"
#include "tests/support/temporary_path.h"

namespace dyngen::runtime {
namespace {

using test::temporary_path;

/// A URDF of two joints whose link 1 has a diagonal inertia and its centre of mass on an axis.
const std::string kUrdf =
    "<robot name=\"pair\"><link name=\"base\"/>\n"
    "<link name=\"a\"><inertial><origin xyz=\"0.2 0 0\"/><mass value=\"3\"/>\n"
    "<inertia ixx=\"0.02\" ixy=\"0\" ixz=\"0\" iyy=\"0.03\" iyz=\"0\" "
    "izz=\"0.03\"/></inertial></link>\n"
    "<link name=\"b\"><inertial><origin xyz=\"0.1 0 0\"/><mass value=\"1\"/>\n"
    "<inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.01\" iyz=\"0\" "
    "izz=\"0.01\"/></inertial></link>\n"
    "<link name=\"c\"><inertial><mass value=\"0.5\"/>\n"
    "<inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" iyy=\"0.01\" iyz=\"0\" "
    "izz=\"0.01\"/></inertial></link>\n"
    "<joint name=\"one\" type=\"revolute\"><parent link=\"base\"/><child link=\"a\"/>"
    "<axis xyz=\"0 1 0\"/></joint>\n"
    "<joint name=\"two\" type=\"revolute\"><origin xyz=\"0.4 0 0\"/><parent link=\"a\"/>"
    "<child link=\"b\"/><axis xyz=\"0 1 0\"/></joint>\n"
    "<joint name=\"side\" type=\"prismatic\"><origin xyz=\"0 0 0.1\"/><parent link=\"a\"/>"
    "<child link=\"c\"/><axis xyz=\"0 1 0\"/></joint></robot>\n";

TEST(RobotForms, ZerosOfADescriptionAreEstimated) {
  if (!has_xml_reader()) GTEST_SKIP() << "built without expat";
  const std::string path = temporary_path("pair.urdf");
  std::ofstream(path) << kUrdf;
  RobotSource source(path);
  source.tip = "b";
  const DescribedRobot described = describe_robot(source, OpenParameters::kAbsentRows);
  EXPECT_EQ(described.linear.joints(), 2);
  // the same numbers in a robot file, where a 0 is known
  const DescribedRobot written = describe_robot(
      parse_robot_file(read_robot_file(source).text, "pair.robot"), OpenParameters::kAbsentRows);
  EXPECT_GT(described.linear.size(), written.linear.size());
  for (const LinearParameter& own : described.linear.parameters) {
    // of rotors, friction and offsets a description without them says nothing
    const bool actuator =
        own.kind != ParameterKind::kInertial || own.formula.find("IA") != std::string::npos;
    EXPECT_TRUE(own.value.has_value() || actuator) << own.name << " begins nowhere";
  }
  const StandardParameters numbers =
      described.standard.array().isNaN().select(0, described.standard);
  const std::string text = identified_text(described, numbers, {{"fitted"}});
  EXPECT_EQ(parse_robot_file(text, "id.robot").joint_names,
            (std::vector<std::string>{"one", "two", "b_frame"}));
}

TEST(RobotForms, IdentifiedNumbersReplaceCadRows) {
  const std::string cad =
      "number_link 2\nal pi/2 0\nd 0 0.4\nm 2 1   # masses\ncX 0.2 0.1\ncY 0 0\ncZ 0 0.05\n"
      "IXX 0.01 0.01\nIYY 0.02 0.02\nIZZ 0.02 0.02\nirX 0 0.3\ngz 9.81\nstop\n";
  const DescribedRobot robot =
      describe_robot(parse_robot_file(cad, "a.robot"), OpenParameters::kAbsentRows);
  StandardParameters standard = StandardParameters::Zero(robot.standard.size());
  for (Eigen::Index i = 0; i < standard.size(); ++i) standard[i] = 1.5;
  const std::string identified = identified_text(robot, standard, {{"fitted"}});
  for (const char* gone : {"cX", "cY", "cZ", "IXX", "IYY", "IZZ", "irX"}) {
    EXPECT_EQ(identified.find(gone), std::string::npos) << gone << "\n" << identified;
  }
  const RobotFile back = parse_robot_file(identified, "id.robot");
  EXPECT_EQ(back.row(RowKey::kMX).values.at(0).text, "1.5");
  EXPECT_EQ(back.row(RowKey::kXX).values.at(1).text, "1.5");
}

TEST(RobotForms, CommandsTakeAUrdf) {
  if (!has_xml_reader()) GTEST_SKIP() << "built without expat";
  const std::string path = temporary_path("pair.urdf"), trajectory = temporary_path("t.csv");
  std::ofstream(path) << kUrdf;
  std::ofstream motion(trajectory);
  motion << "time,q1,q2\n";
  for (int k = 0; k < 500; ++k) {
    const double t = 0.01 * k;
    motion << t << ',' << std::sin(2 * t) << ',' << std::cos(3 * t) << '\n';
  }
  motion.close();
  const std::string robot = path + " --tip b ", run = temporary_path("run.csv");
  const test::Outcome simulated =
      test::dynid("simulate " + robot + "--trajectory " + trajectory + " -o " + run);
  if (simulated.out.find("libboost-dev") != std::string::npos) GTEST_SKIP() << simulated.out;
  ASSERT_EQ(simulated.exit_code, 0) << simulated.out;
  EXPECT_NE(simulated.out.find("joint 'side' moves beside the chain"), std::string::npos)
      << simulated.out;
  const test::Outcome checked = test::dynid("check " + robot + run);
  EXPECT_EQ(checked.exit_code, 0) << checked.out;
  const std::string identified = temporary_path("id.robot");
  const test::Outcome fitted = test::dynid("fit " + robot + run + " -o " + identified);
  EXPECT_EQ(fitted.exit_code, 0) << fitted.out;
  EXPECT_NO_THROW(read_robot_file(identified));
  const test::Outcome refused = test::dynid("check " + path + " --tip hand " + run);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.out.find("--tip 'hand': there is no such link"), std::string::npos);
}

}  // namespace
}  // namespace dyngen::runtime
