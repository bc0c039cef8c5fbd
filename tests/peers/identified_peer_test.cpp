// SPDX-License-Identifier: MIT
// Identified URDF and MJCF loaded by other engines: they have the torque of the robot whose base
// parameters were found.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "gen/robot_output/robot_tree.h"
#include "tests/peers/description_robots.h"
#include "tests/runtime/dynid/identified_robot.h"
#include "tests/support/temporary_path.h"

namespace dyngen::test {
namespace {

constexpr unsigned kRobots = 30;

#ifdef DYNGEN_PEER_KDL_PARSER

TEST(IdentifiedDescription, KdlHasTheTorqueOfTheFit) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<MadeLink> links = made_robot(seed);
    const std::string path =
        written(temporary_path("nominal.urdf"), urdf_of(with_other_bodies(links, seed)));
    const std::string text = into(path, identified_base_parameters(links)).text;
    ByJoint damping;  // KDL knows none: the fit's must be the truth's
    for (const MadeLink& link : links) damping[link.joint] = link.damping;
    expect_same_torques(OwnRobot(urdf_of(links), "truth.urdf"), *kdl_robot(text, damping),
                        fmt::format("seed {}", seed));
    if (testing::Test::HasFailure()) return;
  }
}

#endif

#ifdef DYNGEN_PEER_MUJOCO

TEST(IdentifiedDescription, MujocoHasTheTorqueOfTheFit) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<MadeLink> links = made_robot(seed);
    const RobotFile nominal = parse_robot_file(
        parse_robot(urdf_of(with_other_bodies(links, seed)), "n.urdf").text, "n.robot");
    const std::string path =
        written(temporary_path("nominal.xml"), mjcf_text(nominal, build_model(nominal)).text);
    const std::string text = into(path, identified_base_parameters(links)).text;
    expect_same_torques(OwnRobot(urdf_of(links), "truth.urdf"), *mujoco_robot(text, "m.xml"),
                        fmt::format("seed {}", seed), kMujocoAxes);
    if (testing::Test::HasFailure()) return;
  }
}

#endif

}  // namespace
}  // namespace dyngen::test
