// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "gen/robot_output/robot_tree.h"
#include "gen/symbols/exact.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

std::string all_messages(const WrittenRobot& written) {
  std::string text;
  for (const Diagnostic& own : written.warnings) text += own.message + "\n";
  return text;
}

WrittenRobot written_as(const std::string& text, bool urdf) {
  const RobotFile file = parse_robot_file(text, "arm.robot");
  const RobotModel model = build_model(file);
  return urdf ? urdf_text(file, model) : mjcf_text(file, model);
}

const std::string kSmall =
    "number_link 2\nal 0 pi/2\nd 0 0.3\nm 2 1\nmX 0.2 0.1\nXX 0.02 0.01\nYY 0.04 0.02\nZZ 0.04 "
    "0.02\n"
    "IA 0.3 0\nFs 1 0\nFv 0.5 0.2\nqmin -1 -\nqmax 1 -\ntaumax 50 20\njoints hip knee\n";

TEST(Written, NothingIsLeftOutWithoutAWord) {
  const WrittenRobot urdf = written_as(kSmall + "off 0 0.2\ngz 9.81\nstop\n", true);
  EXPECT_NE(all_messages(urdf).find("IA of joint 'hip'"), std::string::npos);
  EXPECT_NE(all_messages(urdf).find("'off' of joint 2 (knee)"), std::string::npos);
  EXPECT_NE(urdf.text.find("name=\"hip\" type=\"revolute\""), std::string::npos);
  EXPECT_NE(urdf.text.find("name=\"knee\" type=\"continuous\""), std::string::npos);
  EXPECT_NE(urdf.text.find("damping=\"0.5\" friction=\"1\""), std::string::npos);
  const WrittenRobot mjcf = written_as(kSmall +
                                           "gz 9.81\neffect linear_spring joint=1 k=3 c=-6\neffect "
                                           "stribeck joint=2 Fs=1 vs=1\nstop\n",
                                       false);
  EXPECT_NE(mjcf.text.find("armature=\"0.3\""), std::string::npos);
  EXPECT_NE(mjcf.text.find("stiffness=\"3\" springref=\"2\""), std::string::npos);
  EXPECT_NE(all_messages(mjcf).find("effect 'stribeck' is left out"), std::string::npos);
  EXPECT_NE(all_messages(mjcf).find("taumax"), std::string::npos);
  EXPECT_NE(all_messages(written_as(kSmall + "gz 9.8\nstop\n", true)).find("gravity is 9.8"),
            std::string::npos);
}

TEST(Written, WhatCannotBeHeldIsRefused) {
  const auto refused = [](const std::string& rows) -> std::string {
    try {
      (void)written_as("number_link 1\n" + rows + "gz 9.81\nstop\n", true);
      return "";
    } catch (const ModelError& error) {
      return error.what();
    }
  };
  EXPECT_NE(refused("m *\n").find("'m' is unknown"), std::string::npos);
  EXPECT_NE(refused("parameters base\nm 1\n").find("base parameters"), std::string::npos);
  EXPECT_NE(refused("m 0\nmX 1\n").find("no mass"), std::string::npos);
}

std::vector<double> torque(const RobotModel& model, const MotionSample& sample) {
  NumericRobot robot = numeric_robot(model);
  for (NumericJoint& joint : robot.joints) joint.IA = joint.Fs = joint.off = 0;
  const std::vector<double> all = id<double>(
      robot, per_joint(model, sample.q), per_joint(model, sample.dq), per_joint(model, sample.ddq));
  std::vector<double> result;
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (model.joints[j].coordinate >= 0) result.push_back(all[j]);
  }
  return result;
}

/// The robots of robots/ whose numbers are all known, or made known.
TEST(Written, EveryRobotComesBackWithItsTorques) {
  int robots = 0;
  for (const auto& entry : std::filesystem::directory_iterator(DYNGEN_SOURCE_DIR "/robots")) {
    if (entry.path().extension() != ".robot") continue;
    RobotFile file = read_robot_file(entry.path().string());
    if (file.parameters == ParameterMeaning::kBase) continue;
    // a number for what is unknown: the file's own form stays as it is
    unsigned place = 0;
    for (std::size_t key = 0; key < kRowKeyCount; ++key) {
      for (FieldValue& value : file.rows[key].values) {
        ++place;
        if (!value.unknown || value.text == "-") continue;
        value.unknown = false;
        const bool product = key == static_cast<std::size_t>(RowKey::kXY) ||
                             key == static_cast<std::size_t>(RowKey::kXZ) ||
                             key == static_cast<std::size_t>(RowKey::kYZ);
        value.value = GiNaC::numeric(static_cast<int>(7 + place % 5), product ? 1000 : 10);
      }
    }
    file.effects.clear();
    // first moments need masses
    const RobotModel probe = build_model(file);
    bool massless = false;
    for (const JointModel& joint : probe.joints) {
      massless = massless || (joint.chi[index(Chi::kM)].known_zero() &&
                              (!joint.chi[index(Chi::kMX)].known_zero() ||
                               !joint.chi[index(Chi::kMY)].known_zero() ||
                               !joint.chi[index(Chi::kMZ)].known_zero()));
    }
    if (massless) {
      Row& masses = file.rows[static_cast<std::size_t>(RowKey::kM)];
      for (FieldValue& value : masses.values) {
        if (value.value.is_zero()) value.value = 1;
      }
    }
    const RobotModel model = build_model(file);
    for (const bool urdf : {true, false}) {
      const WrittenRobot written = urdf ? urdf_text(file, model) : mjcf_text(file, model);
      const RobotModel back =
          build_model(parse_robot(written.text, urdf ? "back.urdf" : "back.xml"));
      ASSERT_EQ(back.coordinate_count, model.coordinate_count) << entry.path();
      for (const MotionSample& sample : random_samples(model.coordinate_count, 5, 3)) {
        const std::vector<double> expected = torque(model, sample), found = torque(back, sample);
        double size = 0;
        for (const double own : expected) size = std::max(size, std::fabs(own));
        for (std::size_t j = 0; j < expected.size(); ++j) {
          EXPECT_NEAR(found[j], expected[j], 1e-9 * size)
              << entry.path() << (urdf ? " URDF" : " MJCF");
        }
      }
    }
    ++robots;
  }
  EXPECT_GE(robots, 8);
}

}  // namespace
}  // namespace dyngen::test
