// SPDX-License-Identifier: MIT
// Bodies that exist pass without a word, and each way to write one wrongly is warned of.
#include "gen/robot_file/body_checks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "gen/effect_code/checked_robot.h"
#include "tests/support/body_robots.h"

namespace dyngen {
namespace {

using Numbers = std::array<double, 10>;  // XX XY XZ YY YZ ZZ mX mY mZ m

constexpr std::array<const char*, 10> kBodyRows = {"XX", "XY", "XZ", "YY", "YZ",
                                                   "ZZ", "mX", "mY", "mZ", "m"};

std::string file_of(const Numbers& body, int digits) {
  std::string text = "number_link 1\ngz 9.81\nIA 0\n";
  for (std::size_t k = 0; k < body.size(); ++k) {
    text += fmt::format("{} {:.{}g}\n", kBodyRows[k], body[k], digits);
  }
  return text + "stop\n";
}

std::vector<Diagnostic> body_warnings(const std::string& text) {
  return parse_robot_file(text, "body.robot").warnings;
}

TEST(BodyChecks, BodiesThatExistPassAlsoWithFourDigits) {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    for (const int digits : {17, 4}) {
      const std::string text = file_of(test::random_body(seed), digits);
      const std::vector<Diagnostic> warnings = body_warnings(text);
      EXPECT_TRUE(warnings.empty()) << text << warnings.front().message;
    }
  }
}

/// A slender link whose centre of mass is far from its frame.
constexpr Numbers kLink = {0.02, -0.014, -0.038, 0.34, -0.002, 0.33, 0.8, 0.04, 0.1, 2};

TEST(BodyChecks, TheLinkItselfExists) { EXPECT_TRUE(body_warnings(file_of(kLink, 17)).empty()); }

struct BodyMistake {
  std::string name;
  std::function<void(Numbers&)> make;
  std::string message;  ///< a part of it
};

const std::vector<BodyMistake>& body_mistakes() {
  static const std::vector<BodyMistake> all = {
      {"inertia_about_the_centre",
       [](Numbers& n) {
         n[3] -= (n[6] * n[6] + n[8] * n[8]) / n[9];
         n[5] -= (n[6] * n[6] + n[7] * n[7]) / n[9];
       },
       "below the moment of its mass"},
      {"negative_moment", [](Numbers& n) { n[0] = -n[0]; }, "negative moment of inertia"},
      {"one_moment_too_large", [](Numbers& n) { n[5] *= 3; }, "more than XX + YY"},
      {"product_too_large", [](Numbers& n) { n[1] = 0.4; }, "larger than ZZ/2"},
      {"sign_of_a_product", [](Numbers& n) { n[2] = -n[2]; }, "principal moments"},
      {"kilogram_millimetres", [](Numbers& n) { n[6] *= 1000; }, "centre at"},
      {"kilogram_square_millimetres",
       [](Numbers& n) {
         for (std::size_t k = 0; k < 6; ++k) n[k] *= 1e6;
       },
       "radius of gyration"},
      {"nothing", [](Numbers& n) { n.fill(0); }, "neither mass nor inertia"},
      {"no_moment_about_the_axis", [](Numbers& n) { n[5] = 0; }, "at 0.4005 m from the axis"}};
  return all;
}

class BodyMistakes : public testing::TestWithParam<BodyMistake> {};

TEST_P(BodyMistakes, AreWarnedOfAtARow) {
  Numbers body = kLink;
  GetParam().make(body);
  const std::string text = file_of(body, 17);
  bool found = false;
  for (const Diagnostic& warning : body_warnings(text)) {
    EXPECT_GE(warning.position.line, 3);
    EXPECT_FALSE(warning.hint.empty());
    found = found || warning.message.find(GetParam().message) != std::string::npos;
  }
  EXPECT_TRUE(found) << text;
}

INSTANTIATE_TEST_SUITE_P(Body, BodyMistakes, testing::ValuesIn(body_mistakes()),
                         [](const auto& entry) { return entry.param.name; });

/// What is said of rows that are absent, where they are zero.
std::string said_of_absent(const std::string& text) {
  const RobotFile file = parse_robot_file(text, "arm.robot");
  EXPECT_TRUE(file.warnings.empty());  // estimation takes absent rows as unknown
  Diagnostics diagnostics(file.file_name, file.text);
  check_masses(file, AbsentRows::kZero, diagnostics);
  return diagnostics.render();
}

TEST(BodyChecks, AbsentRowsAreZeroOfCodeAlone) {
  EXPECT_EQ(said_of_absent("number_link 1\ngz 9.81\nstop\n"),
            "arm.robot:3:1: warning: joint 1 carries neither mass nor inertia: no such torque is "
            "in the model\n"
            "    3 | stop\n"
            "      | ^ give rows m, mX .. ZZ and IA; write * for what is not known\n");
  EXPECT_EQ(said_of_absent("number_link 2\nm 1 1\nmX 0.5 0.1\nZZ 1 1\ngz 9.81\nstop\n"), "");
  EXPECT_EQ(said_of_absent("number_link 2\nZZ 0 1\ngz 9.81\nstop\n"), "");
  EXPECT_NE(said_of_absent("number_link 2\nZZ 1 0\ngz 9.81\nstop\n").find("joint 2 carries"),
            std::string::npos);
  EXPECT_EQ(said_of_absent("number_link 2\nsigma 0 2\nZZ 1 0\ngz 9.81\nstop\n"), "");
  EXPECT_EQ(said_of_absent("number_link 2\nant 0 0\nIA 1 *\ngz 9.81\nstop\n"), "");
  EXPECT_NE(said_of_absent("number_link 1\nm 2\nmX 1\ngz 9.81\nstop\n")
                .find("2 kg at 0.5 m from the axis of its joint, but 'ZZ' is 0"),
            std::string::npos);
  EXPECT_EQ(said_of_absent("number_link 1\nm 2\nmX 1\nIA 1\ngz 9.81\nstop\n"), "");
  EXPECT_EQ(said_of_absent("number_link 1\nm 2\nmZ 1\ngz 9.81\nstop\n"), "");
}

std::string said_of_effect(const std::string& friction, const std::string& row) {
  const std::string text =
      "number_link 2\nd 0 1\nm 1 1\nZZ 1 1\ngz 9.81\n" + friction + "effect " + row + "\nstop\n";
  CheckedRobot robot;
  robot.file = parse_robot_file(text, "arm.robot");
  robot.catalogue = std::make_shared<EffectCatalogue>();
  Diagnostics diagnostics(robot.file.file_name, robot.file.text);
  add_robot_warnings(robot, build_model(robot.file), AbsentRows::kUnknown, diagnostics);
  return diagnostics.render();
}

TEST(EffectRequirements, AreCheckedOnTheNumbersOfTheRow) {
  EXPECT_EQ(said_of_effect("Fs 2 1\n", "stribeck joint=1 Fs=1.5 vs=0.1"),
            "arm.robot:7:28: warning: effect 'stribeck' of joint 1: Fc = 2, Fs = 1.5: expected Fc "
            "<= Fs\n"
            "    7 | effect stribeck joint=1 Fs=1.5 vs=0.1\n"
            "      |                            ^~~ static friction is not below Coulomb "
            "friction\n");
  EXPECT_EQ(said_of_effect("Fs 2 1\n", "stribeck joint=2 Fs=1.5 vs=0.1"), "");
  EXPECT_EQ(said_of_effect("Fs 2 1\n", "stribeck joint=1 Fs=* vs=0.1"), "");
  EXPECT_EQ(said_of_effect("Fs * *\n", "stribeck joint=1 Fs=1.5 vs=0.1"), "");
  EXPECT_EQ(said_of_effect("", "stribeck joint=1 Fs=1.5 vs=0.1"), "");
  EXPECT_EQ(said_of_effect("Fs 2 1\n", "stribeck joint=2 Fs=6 vs=0.1"),
            "arm.robot:7:28: warning: effect 'stribeck' of joint 2: Fs = 6, Fc = 1: unusual, such "
            "machines have Fs <= 5*Fc\n"
            "    7 | effect stribeck joint=2 Fs=6 vs=0.1\n"
            "      |                            ^ a larger ratio is curved viscous friction\n");
  EXPECT_NE(said_of_effect("", "link_flexibility joint=2 gain=0.1 f=2 zeta=0.05").find("3 <= f"),
            std::string::npos);
  EXPECT_EQ(said_of_effect("", "link_flexibility joint=2 gain=0.1 f=4 zeta=0.05"), "");
  EXPECT_NE(said_of_effect("Fs 2 1\n", "tustin joint=1 Fs=1.5 vs=0.1").find("expected Fc <= Fs"),
            std::string::npos);
  EXPECT_NE(said_of_effect("", "contact joint=1 fz=5 t_on=3 t_off=2").find("t_on <= t_off"),
            std::string::npos);
}

}  // namespace
}  // namespace dyngen
