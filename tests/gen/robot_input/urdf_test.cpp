// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "gen/symbols/exact.h"
#include "gen/urdf/urdf_reader.h"

namespace dyngen {
namespace {

/// Two joints, a camera fixed on link1, and a finger beside the hand.
const std::string kArm = R"(<?xml version="1.0"?>
<robot name="two-link arm">
  <link name="base"><inertial><mass value="9"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="link1">
    <visual><geometry><box size="1 1 1"/></geometry></visual>
    <inertial><origin xyz="0.25 0 0"/><mass value="2"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial>
  </link>
  <link name="camera">
    <inertial><mass value="0.5"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>
  </link>
  <link name="link2">
    <inertial><origin xyz="0.2 0 0" rpy="0 0 1.5707963267948966"/><mass value="1"/>
      <inertia ixx="0.003" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.003"/></inertial>
  </link>
  <link name="hand"/>
  <link name="finger">
    <inertial><mass value="0.1"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="link1"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1.5" upper="1.5" effort="30" velocity="2"/>
    <dynamics damping="0.4" friction="0.7"/>
  </joint>
  <joint name="camera_mount" type="fixed">
    <origin xyz="0.1 0 0"/><parent link="link1"/><child link="camera"/>
  </joint>
  <joint name="elbow" type="continuous">
    <origin xyz="0.5 0 0"/><parent link="link1"/><child link="link2"/>
    <axis xyz="0 0 2"/>
    <limit effort="10" velocity="3"/>
  </joint>
  <joint name="wrist" type="fixed">
    <origin xyz="0.4 0 0"/><parent link="link2"/><child link="hand"/>
  </joint>
  <joint name="grip" type="prismatic">
    <origin xyz="0.05 0 0"/><parent link="hand"/><child link="finger"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="0.04" effort="20" velocity="0.2"/>
  </joint>
</robot>
)";

RobotFile read(const std::string& text, const std::string& tip = "", const std::string& base = "") {
  RobotSource source("arm.urdf");
  source.tip = tip;
  source.base = base;
  return parse_robot(text, source);
}

std::string urdf_error(const std::string& text, const std::string& tip = "",
                       const std::string& base = "") {
  try {
    read(text, tip, base);
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

/// Whether the reader's message has all of these words.
void expect_refused(const std::string& text, const std::vector<std::string>& words) {
  const std::string error = urdf_error(text);
  for (const std::string& word : words) {
    EXPECT_NE(error.find(word), std::string::npos) << word << "\n" << error;
  }
}

double number_at(const RobotFile& file, RowKey key, std::size_t column) {
  return to_double(file.row(key).values.at(column).value);
}

TEST(Urdf, APlanarArmHasTheTableOfAPlanarArm) {
  const RobotFile file = read(kArm, "hand");
  EXPECT_EQ(file.name, "two_link_arm");
  EXPECT_EQ(file.made_of, "URDF");
  EXPECT_EQ(file.joint_names, (std::vector<std::string>{"shoulder", "elbow", "hand_frame"}));
  EXPECT_EQ(file.row(RowKey::kD).values[1].text, "0.5");
  EXPECT_EQ(file.row(RowKey::kD).values[2].text, "0.4");
  for (const RowKey key : {RowKey::kAl, RowKey::kTh, RowKey::kR}) {
    for (const FieldValue& value : file.row(key).values) EXPECT_EQ(value.text, "0");
  }
  // 2 kg at 0.25 m, and the camera's 0.5 kg at 0.1 m
  EXPECT_EQ(file.row(RowKey::kM).values[0].text, "2.5");
  EXPECT_EQ(file.row(RowKey::kMX).values[0].text, "0.55");
  EXPECT_NEAR(number_at(file, RowKey::kZZ, 0), 0.02 + 2 * 0.0625 + 0.5 * 0.01, 1e-15);
  // axes of the inertial turned by a right angle
  EXPECT_NEAR(number_at(file, RowKey::kXX, 1), 0.001, 1e-15);
  EXPECT_NEAR(number_at(file, RowKey::kYY, 1), 0.003 + 0.04, 1e-15);
  EXPECT_EQ(file.row(RowKey::kXY).values[1].text, "0");
  EXPECT_EQ(file.row(RowKey::kFv).values[0].text, "0.4");
  EXPECT_EQ(file.row(RowKey::kFs).values[0].text, "0.7");
  EXPECT_EQ(file.row(RowKey::kQmin).values[0].text, "-1.5");
  EXPECT_EQ(file.row(RowKey::kQmin).values[1].text, "-");
  EXPECT_EQ(file.row(RowKey::kTaumax).values[1].text, "10");
  EXPECT_EQ(file.row(RowKey::kGz).values[0].text, "9.81");
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_NE(file.warnings[0].message.find("joint 'grip' moves beside the chain: 'finger' (0.1 kg)"),
            std::string::npos)
      << file.warnings[0].message;
}

TEST(Urdf, PlacesAreThoseOfTheDescription) {
  const RobotFile file = read(kArm);
  EXPECT_EQ(file.row(RowKey::kM).values[0].position.line, 6);
  EXPECT_EQ(file.row(RowKey::kQmax).values[1].position.line, 32);
  EXPECT_NE(file.text.find("number_link"), std::string::npos);
  EXPECT_EQ(file.source_text, kArm);
}

TEST(Urdf, ABaseElsewhereTurnsGravityOverFixedJoints) {
  std::string text =
      replaced(kArm, "<link name=\"base\">", "<link name=\"world\"/><link name=\"base\">");
  text = replaced(text, "<joint name=\"shoulder\"",
                  "<joint name=\"stand\" type=\"fixed\"><origin rpy=\"1.5707963267948966 0 0\"/>"
                  "<parent link=\"world\"/><child link=\"base\"/></joint><joint name=\"shoulder\"");
  const RobotFile file = read(text, "hand", "base");
  EXPECT_FALSE(file.row(RowKey::kGz).present);
  EXPECT_EQ(file.row(RowKey::kGy).values[0].text, "9.81");
}

TEST(Urdf, JointsThatCannotBeModelledAreRefusedByName) {
  expect_refused(replaced(kArm, "type=\"prismatic\"", "type=\"floating\""),
                 {"arm.urdf:37:28: error: joint 'grip' is floating"});
  expect_refused(replaced(kArm, "type=\"prismatic\"", "type=\"planar\""),
                 {"joint 'grip' is planar"});
  expect_refused(replaced(kArm, "type=\"prismatic\"", "type=\"screw\""),
                 {"joint 'grip' has the type 'screw'"});
  const std::string mimic =
      replaced(kArm, "<axis xyz=\"0 1 0\"/>", "<axis xyz=\"0 1 0\"/><mimic joint=\"elbow\"/>");
  expect_refused(mimic, {"arm.urdf:39:", "joint 'grip' mimics joint 'elbow'"});
  EXPECT_EQ(urdf_error(mimic, "hand"), "") << "the finger is no part of the chain";
}

TEST(Urdf, XacroIsRefusedWithTheCommand) {
  const std::string text =
      "<robot name=\"r\" xmlns:xacro=\"http://ros.org/wiki/xacro\">\n"
      "<xacro:property name=\"L\" value=\"1\"/><link name=\"a\"/></robot>";
  expect_refused(text,
                 {"arm.urdf:2:1: error: this is a xacro file", "xacro arm.urdf.xacro > arm.urdf"});
  expect_refused(replaced(kArm, "0.25 0 0", "${L/2} 0 0"), {"this is a xacro file"});
  EXPECT_EQ(urdf_error(replaced(kArm, "<robot ", "<robot xmlns:xacro=\"x\" ")), "")
      << "expanded files keep the name space";
}

TEST(Urdf, WrongTreesAreRefused) {
  expect_refused("<robot name=\"rr\">\n  <link name=\"base\"/>\n</robot>",
                 {"arm.urdf:1:1: error: the robot is one link and has no joints"});
  expect_refused("<robot name=\"rr\"/>", {"no <link>"});
  expect_refused(replaced(kArm, "<child link=\"hand\"/>", "<child link=\"foot\"/>"),
                 {"link 'foot', which does not exist"});
  expect_refused(replaced(kArm, "<link name=\"hand\"/>", "<link name=\"link2\"/>"),
                 {"link 'link2' stands twice"});
  expect_refused(replaced(kArm, "<child link=\"hand\"/>", "<child link=\"finger\"/>"),
                 {"link 'finger' is the child of joint 'wrist' and of joint 'grip'"});
  expect_refused(
      replaced(kArm, "<link name=\"hand\"/>", "<link name=\"hand\"/><link name=\"tool\"/>"),
      {"2 roots: links 'base' and 'tool'"});
  expect_refused(replaced(kArm, "<parent link=\"base\"/>", "<parent link=\"finger\"/>"),
                 {"part of a loop"});
  expect_refused(replaced(kArm, "name=\"elbow\"", "name=\"shoulder\""),
                 {"joint 'shoulder' stands twice"});
  EXPECT_NE(urdf_error(kArm, "arm").find("--tip 'arm': there is no such link"), std::string::npos);
  EXPECT_NE(urdf_error(kArm, "camera", "link1").find("no joint moves between"), std::string::npos);
}

TEST(Urdf, WrongNumbersAreRefusedWithTheirPlace) {
  expect_refused(replaced(kArm, "<axis xyz=\"0 0 2\"/>", "<axis xyz=\"0 0 0\"/>"),
                 {"arm.urdf:31:16: error: the axis of joint 'elbow' has no length"});
  expect_refused(replaced(kArm, "\"0.25 0 0\"", "\"0,25 0 0\""),
                 {"'0,25' in 'xyz' is not a number"});
  expect_refused(replaced(kArm, "\"0.25 0 0\"", "\"0.25 0\""), {"'xyz' has 2 numbers"});
  expect_refused(replaced(kArm, "<mass value=\"2\"/>", ""),
                 {"inertial of link 'link1' has no <mass>"});
  expect_refused(replaced(kArm, "izz=\"0.02\"", ""), {"has no attribute 'izz'"});
  expect_refused(replaced(kArm, "lower=\"-1.5\"", "lower=\"2\""),
                 {"lower of joint 'shoulder' is 2"});
}

TEST(Urdf, OtherXmlIsRefusedByName) {
  expect_refused("<?xml version=\"1.0\"?>\n<!-- <robot> -->\n<sdf version=\"1.7\"/>",
                 {"arm.urdf:3:2: error: this is SDF"});
  expect_refused("<html></html>", {"root <html>"});
}

std::string warnings_text(const std::string& text) {
  std::string all;
  for (const Diagnostic& own : read(text).warnings) all += own.message + "\n";
  return all;
}

TEST(Urdf, WhatIsDoubtfulOrLeftOutIsSaid) {
  EXPECT_EQ(warnings_text(kArm), "");
  EXPECT_NE(warnings_text(replaced(kArm, "ixx=\"0.01\"", "ixx=\"0.09\"")).find("'link1'"),
            std::string::npos);
  EXPECT_NE(warnings_text(replaced(kArm, "<mass value=\"0.1\"/>", "<mass value=\"0\"/>"))
                .find("joint 'grip' carries neither mass nor inertia"),
            std::string::npos);
  const std::string rounded =
      replaced(kArm, "<origin xyz=\"0.5 0 0\"/>", "<origin xyz=\"0.5 0 0\" rpy=\"1.5708 0 0\"/>");
  EXPECT_NE(warnings_text(rounded).find("rpy of joint 'elbow': 1.5708 is nearly"),
            std::string::npos);
  RobotSource source("arm.urdf");
  source.round_angles = 1e-4;
  const RobotFile exact = parse_robot(rounded, source);
  EXPECT_TRUE(exact.warnings.empty());
  EXPECT_NE(warnings_text(replaced(kArm, "<link name=\"hand\"/>", "<link name=\"hand\"/><spring/>"))
                .find("<spring> in the robot is unknown"),
            std::string::npos);
  EXPECT_NE(warnings_text(replaced(kArm, "<link name=\"hand\"/>",
                                   "<link name=\"hand\"/><gazebo reference=\"grip\">"
                                   "<springStiffness>3</springStiffness></gazebo>"))
                .find("<springStiffness> of <gazebo reference=\"grip\">"),
            std::string::npos);
  EXPECT_EQ(warnings_text(replaced(kArm, "<link name=\"hand\"/>",
                                   "<link name=\"hand\"/><transmission name=\"t\"><type>x</type>"
                                   "</transmission><gazebo><plugin/></gazebo>")),
            "");
}

TEST(Urdf, AttributesThatItDoesNotHaveAreNamed) {
  for (const auto& [right, wrong, word] :
       {std::tuple{"<origin xyz=\"0.5 0 0\"/>", "<origin xyz=\"0.5 0 0\" quat_xyzw=\"1 0 0 0\"/>",
                   "'quat_xyzw' is no attribute of <origin> in URDF"},
        std::tuple{"<origin xyz=\"0.5 0 0\"/>", "<origin xzy=\"0.5 0 0\"/>", "'xzy'"},
        std::tuple{"ixx=\"0.01\"", "ixx=\"0.01\" iyx=\"0\"",
                   "'iyx' is no attribute of <inertia>"}}) {
    const std::string text = replaced(kArm, right, wrong);
    ASSERT_NE(text, kArm);
    EXPECT_NE(warnings_text(text).find(word), std::string::npos) << warnings_text(text);
  }
}

TEST(Urdf, ZerosOfADescriptionAreNumbers) {
  const RobotFile file = read(kArm, "hand");
  EXPECT_FALSE(file.made_of.empty());
}

}  // namespace
}  // namespace dyngen
