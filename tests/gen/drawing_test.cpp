// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "gen/drawing/arm_drawing.h"
#include "gen/drawing/arm_parts.h"
#include "gen/drawing/view.h"
#include "tests/support/model_bridge.h"

namespace dyngen::test {
namespace {

const std::string kTree =
    "number_link 5\nant 0 1 1 3 2\nsigma 0 0 2 1 0\nal 0 pi/2 0.3 pi 0\nd 0.1 0.4 -0.2 0.3 0\n"
    "th 0.2 0 pi/3 0 0\nr 0.3 0.1 0 * 0.15\ngz 9.81\nstop\n";

std::vector<RobotModel> models() {
  std::vector<RobotModel> result;
  for (const char* name : {"robots/kuka_iiwa14", "robots/panda", "robots/planar2r",
                           "robots/puma560", "robots/puma560_3dof", "robots/rx90",
                           "robots/sarcos_grla", "robots/scara", "robots/stanford", "robots/tx40",
                           "robots/ur10e", "tests/robots/odd_angles", "tests/robots/pendulum"}) {
    result.push_back(read_model(std::string(name) + ".robot"));
  }
  result.push_back(parse_model(kTree));
  return result;
}

/// Why a text is no XML as dyngen writes it: elements that do not nest, a bare < or &, a number
/// that is none.
std::string fault(const std::string& text) {
  static const std::regex kTag(R"re(<(/?)([a-z]+)((?: [a-zA-Z:-]+="[^"<]*")*)(/?)>)re");
  std::vector<std::string> open;
  std::string rest;
  auto from = text.begin();
  for (std::sregex_iterator tag(text.begin(), text.end(), kTag), end; tag != end; ++tag) {
    rest.append(from, (*tag)[0].first);
    from = (*tag)[0].second;
    const std::string name = (*tag)[2];
    if ((*tag)[1].length() > 0) {
      if (open.empty() || open.back() != name) return "</" + name + "> closes nothing";
      open.pop_back();
      if (open.empty() && std::string(from, text.end()) != "\n") return "text after the root";
    } else if ((*tag)[4].length() == 0) {
      open.push_back(name);
    }
  }
  if (!open.empty()) return "<" + open.back() + "> is open";
  if (rest.find('<') != std::string::npos) return "a bare <";
  static const std::regex kEntity("&(lt|gt|amp|quot);");
  if (std::regex_replace(text, kEntity, "").find('&') != std::string::npos) return "a bare &";
  return std::regex_search(text, std::regex("[\", ]-?(nan|inf)")) ? "not a number" : "";
}

TEST(ArmDrawing, IsWellFormed) {
  for (const RobotModel& model : models()) EXPECT_EQ(fault(arm_drawing(model)), "") << model.name;
  EXPECT_NE(fault("<svg><g></svg>\n"), "");
  EXPECT_NE(fault("<svg><text x=\"nan\">a</text></svg>\n"), "");
  EXPECT_NE(fault("<svg>a & b</svg>\n"), "");
}

TEST(ArmDrawing, HasEveryJointAndEveryFrame) {
  for (const RobotModel& model : models()) {
    const std::string text = arm_drawing(model);
    for (int j = 1; j <= model.size(); ++j) {
      EXPECT_NE(text.find(fmt::format("id=\"joint-{}\"", j)), std::string::npos) << model.name;
    }
    for (int j = 0; j <= model.size(); ++j) {
      for (const char axis : {'x', 'z'}) {
        const std::regex label(fmt::format("<text[^>]*>([a-z0-9 ]* )?{}{}[ <]", axis, j));
        EXPECT_TRUE(std::regex_search(text, label)) << model.name << " " << axis << j;
      }
    }
    EXPECT_NE(text.find("class=\"scale\""), std::string::npos);
  }
}

TEST(ArmDrawing, HasBodiesOnTheirAxesAndLinksThatHangTogether) {
  for (const RobotModel& model : models()) {
    const Posture posture = make_posture(model);
    const ArmParts parts = arm_parts(posture, {0, 0, 1});
    ASSERT_EQ(parts.bodies.size(), model.joints.size());
    for (const ArmParts::Body& body : parts.bodies) {
      const Frame frame = posture.frame(body.joint);
      EXPECT_LT(norm(cross(body.centre - frame.origin, frame.z)), 1e-9 * parts.size);
    }
    // what hangs on the base by rods
    std::vector<Vec3> reached = {parts.ground.centre, {}};
    const auto is_reached = [&](const Vec3& place) {
      return std::any_of(reached.begin(), reached.end(), [&](const Vec3& other) {
        return norm(other - place) < 1e-6 * parts.size;
      });
    };
    for (std::size_t round = 0; round <= parts.rods.size(); ++round) {
      for (const ArmParts::Rod& rod : parts.rods) {
        if (is_reached(rod.from) && !is_reached(rod.to)) reached.push_back(rod.to);
        if (is_reached(rod.to) && !is_reached(rod.from)) reached.push_back(rod.from);
      }
    }
    for (const PosedLink& link : posture.links) {
      EXPECT_TRUE(is_reached(link.frame.origin)) << model.name;
    }
    for (const ArmParts::Body& body : parts.bodies) {
      EXPECT_TRUE(is_reached(body.centre)) << model.name << " " << body.joint;
    }
  }
}

TEST(ArmDrawing, HasGravityDownwards) {
  for (const Vec3& up : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, unit(Vec3{0, -1, 1}), Vec3{-1, 0, 0}}) {
    const Posture posture = make_posture(read_model("robots/puma560.robot"));
    const Viewpoint view = choose_view(arm_parts(posture, up), up);
    const Point weight = view.project(-up);
    EXPECT_NEAR(weight.x, 0, 1e-12);
    EXPECT_LT(weight.y, -0.7);
    EXPECT_NEAR(dot(cross(view.right, view.up), view.towards), 1, 1e-12);  // no mirror
  }
}

TEST(ArmDrawing, SaysWhatItAssumes) {
  const std::string text = arm_drawing(parse_model(kTree));
  EXPECT_NE(text.find("r4 = 0.2 m in place of a run-time length"), std::string::npos) << text;
  EXPECT_NE(arm_drawing(read_model("robots/panda.robot")).find("joint 4 at -90 deg"),
            std::string::npos);
}

TEST(ArmDrawing, EscapesNames) {
  RobotModel model = read_model("tests/robots/rp.robot");
  model.joints[0].name = "<script>&\"";
  const std::string text = arm_drawing(model);
  EXPECT_EQ(fault(text), "");
  EXPECT_EQ(text.find("<script"), std::string::npos);
}

TEST(ArmDrawing, IsTheSameTwice) {
  const RobotModel model = read_model("robots/stanford.robot");
  EXPECT_EQ(arm_drawing(model), arm_drawing(model));
}

}  // namespace
}  // namespace dyngen::test
