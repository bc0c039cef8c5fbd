// SPDX-License-Identifier: MIT
#include "gen/posture/posture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "gen/explain/place_text.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"

namespace dyngen::test {
namespace {

const std::string kTreeFile =
    "number_link 5\nant 0 1 1 3 2\nsigma 0 0 2 1 0\nal 0 pi/2 0.3 pi 0\nd 0.1 0.4 -0.2 0.3 0\n"
    "th 0.2 0 pi/3 0 0\nr 0.3 0.1 0 0.2 0.15\ngz 9.81\nstop\n";

std::string words(const RobotModel& model) { return describe_places(make_posture(model)); }

/// The largest difference of a frame from the judge's, which knows the file's frames.
double difference(const Frame& frame, const Transform<double>& judged) {
  const Vec3 columns[4] = {frame.x, frame.y, frame.z, frame.origin};
  double largest = 0;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d own(columns[k].x, columns[k].y, columns[k].z);
    largest = std::max(largest, (own - judged.col(k).head<3>()).cwiseAbs().maxCoeff());
  }
  return largest;
}

void expect_as_judged(const RobotModel& given) {
  const RobotModel model = with_random_values(given, 7);  // of unknown inertia; no length is
  const Posture posture = make_posture(model);
  std::vector<double> q;
  for (const PosedLink& link : posture.links) q.push_back(link.q);
  const auto judged = forward_kinematics<double>(numeric_robot(model), q);
  for (int j = 1; j <= model.size(); ++j) {
    const std::size_t place = static_cast<std::size_t>(j - 1);
    // sines of exact angles and of doubles differ by rounding
    EXPECT_LT(difference(posture.link(j).tip, judged[place]), 1e-12) << model.name << " " << j;
    if (model.convention == DhConvention::kModified) {
      EXPECT_LT(difference(posture.link(j).frame, judged[place]), 1e-12) << model.name << " " << j;
    } else if (j > 1) {  // joint j turns about z of the file's frame j - 1
      const Eigen::Vector3d axis = judged[place - 1].col(2).head<3>();
      const Vec3 z = posture.link(j).frame.z;
      EXPECT_LT((axis - Eigen::Vector3d(z.x, z.y, z.z)).norm(), 1e-12) << model.name << " " << j;
    }
  }
}

TEST(Posture, FramesAreThoseOfTheNumericJudge) {
  for (const char* name :
       {"robots/kuka_iiwa14", "robots/panda", "robots/planar2r", "robots/puma560",
        "robots/puma560_3dof", "robots/rx90", "robots/sarcos_grla", "robots/scara",
        "robots/stanford", "robots/tx40", "robots/ur10e", "tests/robots/puma560_corke_std",
        "tests/robots/odd_angles", "tests/robots/flip3r", "tests/robots/rp"}) {
    expect_as_judged(read_model(std::string(name) + ".robot"));
  }
  expect_as_judged(parse_model(kTreeFile));
}

TEST(Posture, OfThePumaIsThatOfItsPaper) {  // Armstrong, Khatib and Burdick 1986, figure 1
  const std::string text = words(read_model("robots/puma560.robot"));
  EXPECT_NE(text.find("shoulder    turns about +y through (0, 0.2435, 0); x2 along +x"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("elbow       turns about +y through (0.4318, 0.1501, 0)"), std::string::npos)
      << text;
  EXPECT_NE(text.find("wrist_pitch turns about +y through (0.4115, 0.1501, 0.4331)"),
            std::string::npos)
      << text;
}

TEST(Posture, AWrongSignChangesTheWords) {
  for (const char* name : {"robots/puma560.robot", "robots/ur10e.robot", "robots/panda.robot",
                           "tests/robots/puma560_corke_std.robot"}) {
    const RobotModel model = read_model(name);
    const std::string right = words(model);
    int changes = 0;
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      const JointModel& joint = model.joints[i];
      const auto expect_other_words = [&](const char* row, JointModel wrong) {
        RobotModel other = model;
        other.joints[i] = std::move(wrong);
        EXPECT_NE(words(other), right) << name << ": " << row << " of joint " << i + 1;
        ++changes;
      };
      JointModel wrong = joint;
      wrong.alpha = -joint.alpha;
      if (!joint.alpha.is_zero()) expect_other_words("al", wrong);
      wrong = joint;
      wrong.d.value = -joint.d.value;
      if (!joint.d.known_zero()) expect_other_words("d", wrong);
      wrong = joint;
      wrong.r.value = -joint.r.value;
      if (!joint.r.known_zero()) expect_other_words("r", wrong);
      wrong = joint;
      wrong.theta = joint.theta + GiNaC::Pi / 2;
      expect_other_words("th", wrong);
    }
    EXPECT_GE(changes, 12) << name;
  }
}

TEST(Posture, IsAtZeroWhereZeroCanBeSeen) {
  EXPECT_EQ(configuration_text(make_posture(read_model("robots/puma560.robot"))),
            "all joints at 0");
  EXPECT_EQ(configuration_text(make_posture(read_model("tests/robots/pendulum.robot"))),
            "the joint at 0");
}

TEST(Posture, LeavesZeroWhereLimitsDo) {
  EXPECT_EQ(configuration_text(make_posture(read_model("robots/panda.robot"))),
            "joint 4 at -90 deg, the others at 0");
  const std::string narrow = "number_link 2\nd 0 1\nqmin 0.1 0\nqmax 0.3 1\ngy 9.81\nstop\n";
  EXPECT_EQ(configuration_text(make_posture(parse_model(narrow))),
            "joint 1 at 11.46 deg, the other at 0");
}

TEST(Posture, DrawsOutAPrismaticJointWithoutLength) {
  const std::string text = "number_link 2\nsigma 0 1\nal 0 pi/2\nd 0.3 0\ngz 9.81\n";
  EXPECT_EQ(configuration_text(make_posture(parse_model(text + "stop\n"))),
            "joint 2 at 0.3 m, the other at 0");
  const std::string limits = "qmin -1 -0.5\nqmax 1 -0.1\nstop\n";
  EXPECT_EQ(configuration_text(make_posture(parse_model(text + limits))),
            "joint 2 at -0.3 m, the other at 0");
}

TEST(Posture, BendsAnArmThatLiesOnItself) {
  const std::string text = "number_link 3\nd 0 0.5 -0.4\nr 0 0 0\ngy 9.81\n";
  EXPECT_EQ(configuration_text(make_posture(parse_model(text + "stop\n"))),
            "joint 2 at 90 deg, the others at 0");
  const std::string limits = "qmin -2 -2 -2\nqmax 2 1 2\nstop\n";
  EXPECT_EQ(configuration_text(make_posture(parse_model(text + limits))),
            "joint 2 at -90 deg, the others at 0");
}

TEST(Posture, SaysWhatStandsForARunTimeLength) {
  const Posture posture =
      make_posture(parse_model("number_link 3\nd 0 * 0.4\nr 0 0 *\ngz *\nstop\n"));
  EXPECT_EQ(stand_in_text(posture), "d2 = r3 = 0.4 m in place of run-time lengths");
  EXPECT_DOUBLE_EQ(posture.link(2).frame.origin.x, 0.4);
  EXPECT_FALSE(posture.weight);
  const std::string flat =
      std::regex_replace(describe_places(posture), std::regex("\\s+"), " ");  // lines are filled
  EXPECT_NE(flat.find("all joints at 0, with d2 = r3 = 0.4 m in place of"), std::string::npos);
}

}  // namespace
}  // namespace dyngen::test
