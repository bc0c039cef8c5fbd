// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "gen/mjcf/mjcf_reader.h"
#include "gen/robot_input/robot_input.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

BodyTree tree_of(const std::string& text) { return read_mjcf(parse_xml(text, "arm.xml")); }

std::string in_world(const std::string& bodies, const std::string& head = "") {
  return "<mujoco model=\"arm\">" + head + "<worldbody>" + bodies + "</worldbody></mujoco>";
}

std::string mjcf_error(const std::string& text) {
  try {
    parse_robot(text, "arm.xml");
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

void expect_mjcf_refused(const std::string& text, const std::string& words) {
  const std::string error = mjcf_error(text);
  EXPECT_NE(error.find(words), std::string::npos) << words << "\n" << error;
}

constexpr const char* kInertial =
    "<inertial pos=\"0 0 0\" mass=\"1\" diaginertia=\"0.01 0.01 0.01\"/>";

TEST(Mjcf, AnglesAreDegreesUnlessTheModelSaysRadians) {
  const std::string body = std::string("<body name=\"a\" euler=\"90 0 0\">") + kInertial +
                           "<joint name=\"j\" range=\"-90 90\"/></body>";
  const BodyTree degrees = tree_of(in_world(body));
  EXPECT_NEAR(static_cast<double>(degrees.joints[0].pose.R[2][1]), 1, 1e-18);
  EXPECT_NEAR(static_cast<double>(*degrees.joints[0].upper), std::numbers::pi / 2, 1e-16);
  const BodyTree radians = tree_of(in_world(body, "<compiler angle=\"radian\"/>"));
  EXPECT_NEAR(static_cast<double>(radians.joints[0].pose.R[2][1]), std::sin(90), 1e-15);
  EXPECT_EQ(*radians.joints[0].upper, 90);
}

TEST(Mjcf, EulerSequencesTurnWithTheBodyOrStand) {
  const std::string body = std::string("<body name=\"a\" euler=\"30 40 50\">") + kInertial +
                           "<joint name=\"j\"/></body>";
  const Real d = kRealPi / 180;
  const auto expect_turn = [&](const std::string& sequence, const RealMatrix& expected) {
    const BodyTree tree = tree_of(in_world(body, "<compiler eulerseq=\"" + sequence + "\"/>"));
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(static_cast<double>(tree.joints[0].pose.R[i][k]),
                    static_cast<double>(expected[i][k]), 1e-16)
            << sequence;
      }
    }
  };
  expect_turn("xyz", turn_x(30 * d) * turn_y(40 * d) * turn_z(50 * d));
  expect_turn("XYZ", turn_z(50 * d) * turn_y(40 * d) * turn_x(30 * d));
  expect_turn("zyx", turn_z(30 * d) * turn_y(40 * d) * turn_x(50 * d));
}

TEST(Mjcf, DefaultClassesAreNestedAndInherited) {
  const BodyTree tree = tree_of(in_world(
      std::string("<body name=\"a\" childclass=\"arm\">") + kInertial +
          "<joint name=\"one\"/><body name=\"b\">" + kInertial +
          "<joint name=\"two\" class=\"wrist\" damping=\"9\"/></body></body><body name=\"c\">" +
          kInertial + "<joint name=\"three\"/></body>",
      "<default><joint armature=\"0.5\"/><default class=\"arm\"><joint damping=\"2\" axis=\"0 1 "
      "0\"/>"
      "<default class=\"wrist\"><joint frictionloss=\"0.3\" type=\"slide\"/></default></default>"
      "</default>"));
  ASSERT_EQ(tree.joints.size(), 3U);
  EXPECT_EQ(*tree.joints[0].armature, 0.5L);
  EXPECT_EQ(*tree.joints[0].damping, 2);
  EXPECT_EQ(tree.joints[0].axis[1], 1);
  EXPECT_FALSE(tree.joints[0].friction);
  EXPECT_EQ(tree.joints[1].type, TreeJointType::kPrismatic);
  EXPECT_EQ(*tree.joints[1].damping, 9);
  EXPECT_EQ(*tree.joints[1].friction, 0.3L);
  EXPECT_EQ(tree.joints[1].axis[1], 1);
  EXPECT_EQ(*tree.joints[2].armature, 0.5L);
  EXPECT_FALSE(tree.joints[2].damping);
  EXPECT_EQ(tree.joints[2].axis[2], 1);
}

/// Of a body with one geom and MuJoCo's density of water.
TreeBody geom_body(const std::string& geom) {
  return tree_of(in_world("<body name=\"a\"><joint name=\"j\"/><geom " + geom + "/></body>"))
      .bodies[1];
}

TEST(Mjcf, GeomsHaveTheInertiaOfTheirSolids) {
  const double pi = std::numbers::pi;
  const auto moment = [](const TreeBody& body, std::size_t k) {
    return static_cast<double>(body.inertia[k][k]);
  };
  const TreeBody box = geom_body("type=\"box\" size=\"0.1 0.2 0.3\" pos=\"1 0 0\"");
  EXPECT_NEAR(static_cast<double>(box.mass), 48, 1e-12);
  EXPECT_NEAR(moment(box, 0), 48 * (0.04 + 0.09) / 3, 1e-12);
  EXPECT_EQ(box.centre[0], 1);
  const TreeBody ball = geom_body("size=\"0.1\" mass=\"2\"");
  EXPECT_NEAR(moment(ball, 1), 2 * 0.4 * 0.01, 1e-16);
  const TreeBody tube = geom_body("type=\"cylinder\" size=\"0.1 0.4\" density=\"100\"");
  EXPECT_NEAR(static_cast<double>(tube.mass), 100 * pi * 0.01 * 0.8, 1e-12);
  const TreeBody capsule =
      geom_body("type=\"capsule\" size=\"0.1\" fromto=\"0 0 0 0 0.6 0\" mass=\"3\"");
  EXPECT_NEAR(static_cast<double>(capsule.centre[1]), 0.3, 1e-16);
  EXPECT_LT(moment(capsule, 1), moment(capsule, 0));
  EXPECT_NEAR(moment(capsule, 0), moment(capsule, 2), 1e-15);
  const TreeBody ellipsoid = geom_body("type=\"ellipsoid\" size=\"0.1 0.2 0.3\" mass=\"5\"");
  EXPECT_NEAR(moment(ellipsoid, 2), 0.04 + 0.01, 1e-15);
  EXPECT_EQ(geom_body("type=\"plane\" size=\"1 1 1\"").mass, 0);
}

TEST(Mjcf, InertiaComesFromWhereTheModelSays) {
  const std::string body = std::string("<body name=\"a\"><joint name=\"j\"/>") + kInertial +
                           "<geom size=\"0.1\" mass=\"7\" group=\"3\"/></body>";
  const auto mass = [&](const std::string& compiler) {
    return static_cast<double>(
        tree_of(in_world(body, "<compiler " + compiler + "/>")).bodies[1].mass);
  };
  EXPECT_EQ(mass(""), 1);
  EXPECT_EQ(mass("inertiafromgeom=\"true\""), 7);
  EXPECT_EQ(mass("inertiafromgeom=\"true\" inertiagrouprange=\"0 2\""), 0);
  EXPECT_EQ(mass("inertiafromgeom=\"false\""), 1);
  EXPECT_EQ(mass("boundmass=\"3\""), 3);
  EXPECT_EQ(mass("settotalmass=\"5\""), 5);
}

TEST(Mjcf, SeveralJointsOfABodyAndReferencesAreSteps) {
  const RobotFile file = parse_robot(
      in_world(std::string("<body name=\"a\"><joint name=\"x\" type=\"slide\" axis=\"1 0 0\" "
                           "ref=\"0.2\"/><joint name=\"z\" axis=\"0 0 1\" pos=\"0.1 0 0\" "
                           "ref=\"90\"/>") +
               kInertial + "</body>"),
      "arm.xml");
  EXPECT_EQ(file.made_of, "MJCF");
  EXPECT_EQ(file.joint_names.back(), "z");
}

TEST(Mjcf, ASpringIsAnEffect) {
  const RobotFile file = parse_robot(
      in_world(
          std::string("<body name=\"a\"><joint name=\"x\" stiffness=\"4\" springref=\"90\"/>") +
          "<inertial pos=\"0.1 0 0\" mass=\"1\" diaginertia=\"0.01 0.01 0.01\"/></body>"),
      "arm.xml");
  ASSERT_EQ(file.effects.size(), 1U);
  EXPECT_EQ(file.effects[0].name, "linear_spring");
  EXPECT_EQ(file.effects[0].position.line, 1);
  EXPECT_NE(file.text.find("effect linear_spring joint=1 k=4 c=-6.2831853071796"),
            std::string::npos)
      << file.text;
}

TEST(Mjcf, WhatIsNotModelledIsRefusedByName) {
  const std::string arm = std::string("<body name=\"a\"><joint name=\"j\"/>") + kInertial +
                          "<body name=\"b\"><joint name=\"k\"/>" + kInertial + "</body></body>";
  EXPECT_EQ(mjcf_error(in_world(arm)), "");
  expect_mjcf_refused(
      in_world(std::string("<body name=\"a\"><freejoint name=\"f\"/>") + kInertial + "</body>"),
      "joint 'f' is a free joint");
  expect_mjcf_refused(
      in_world(std::string("<body name=\"a\"><joint type=\"ball\"/>") + kInertial + "</body>"),
      "is a ball joint");
  expect_mjcf_refused(in_world(arm + "<replicate count=\"2\"/>"), "<replicate> is not read");
  expect_mjcf_refused(in_world(arm + "<include file=\"b.xml\"/>"), "<include> is not read");
  expect_mjcf_refused(in_world(arm, "<compiler coordinate=\"global\"/>"), "coordinate=\"global\"");
  expect_mjcf_refused(in_world(arm, "<equality><joint joint1=\"j\" joint2=\"k\"/></equality>"),
                      "arm.xml:1:");
  expect_mjcf_refused(in_world(arm, "<equality><joint joint1=\"j\" joint2=\"k\"/></equality>"),
                      "couples joint 'j'");
  expect_mjcf_refused(in_world(arm, "<equality><weld body1=\"b\"/></equality>"), "couples joint");
  expect_mjcf_refused(
      in_world(arm,
               "<tendon><fixed name=\"t\" stiffness=\"3\"><joint joint=\"k\" coef=\"1\"/>"
               "</fixed></tendon>"),
      "tendon 't' couples joint 'k'");
  expect_mjcf_refused(in_world("<body name=\"a\"><joint/><geom type=\"mesh\" mesh=\"m\"/></body>"),
                      "its geom is a mesh");
  expect_mjcf_refused(
      in_world(std::string("<body name=\"a\"><joint class=\"no\"/>") + kInertial + "</body>"),
      "default class 'no' does not exist");
  expect_mjcf_refused(in_world("<body name=\"a\"/>"), "no joint moves");
  RobotSource source("arm.xml");
  source.tip = "a";
  EXPECT_NO_THROW(parse_robot(in_world(arm, "<equality><joint joint1=\"k\"/></equality>"), source));
}

TEST(Mjcf, WordsThatItDoesNotHaveAreNamed) {
  const std::string joint = "<joint name=\"j\"/>";
  const auto body = [&](const std::string& inner) {
    return "<body name=\"a\">" + inner + kInertial + "</body>";
  };
  const auto expect_warned = [](const std::string& text, const std::string& words) {
    std::string all;
    for (const Diagnostic& own : parse_robot(text, "arm.xml").warnings) {
      all += own.message + "; " + own.hint + "\n";
    }
    EXPECT_NE(all.find(words), std::string::npos) << words << "\n" << all;
  };
  expect_warned(in_world(body(joint), "<compiler angl=\"radian\"/>"),
                "'angl' is no attribute of <compiler> in MJCF: it is passed over; did you mean "
                "'angle'?");
  expect_warned(in_world(body("<joint name=\"j\" dampng=\"2\"/>")), "did you mean 'damping'?");
  expect_warned(in_world(body(joint), "<default><joint dampng=\"2\"/></default>"), "'dampng'");
  expect_warned(in_world("<body psition=\"0 0 1\">" + joint + kInertial + "</body>"), "'psition'");
  expect_warned(in_world(body(joint + "<geom ps=\"0 0 1\" size=\"0.1\"/>")), "'ps'");
  expect_warned(in_world(body(joint), "<option gravty=\"0 0 -1\"/>"), "did you mean 'gravity'?");
  expect_warned(in_world(body(joint) + "<bdy/>"), "did you mean <body>?");
  expect_warned(in_world(body(joint), "<compiler discardvisual=\"true\"/>"), "do not collide");

  expect_mjcf_refused(in_world(body("<joint name=\"j\" limited=\"yes\"/>")),
                      "'yes' is no value of limited");
  expect_mjcf_refused(in_world(body(joint) + "<joint name=\"k\"/>"),
                      "a <joint> stands in the world");
  expect_mjcf_refused(in_world(body(joint + kInertial)), "a second <inertial>");
  const std::string full =
      "<inertial pos=\"0 0 0\" mass=\"1\" fullinertia=\"0.01 0.01 0.01 0 0 0\"";
  expect_mjcf_refused(
      in_world("<body>" + joint + full + " diaginertia=\"0.01 0.01 0.01\"/></body>"),
      "fullinertia stands beside diaginertia");
  expect_mjcf_refused(in_world("<body>" + joint + full + " euler=\"0 0 90\"/></body>"),
                      "euler stands beside fullinertia");
  for (const std::string own : {"mass", "density"}) {
    expect_mjcf_refused(
        in_world("<body>" + joint + "<geom size=\"0.1\" " + own + "=\"-1\"/></body>"),
        "the " + own + " of the geom is negative");
  }
}

}  // namespace
}  // namespace dyngen
