// SPDX-License-Identifier: MIT
// The same URDF and MJCF read by dyngen and by other engines: torques of random states.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "gen/model/robot_model.h"
#include "gen/robot_input/robot_input.h"
#include "gen/robot_output/robot_tree.h"
#include "tests/gen/robot_input/description_text.h"
#include "tests/peers/description_robots.h"
#include "tests/peers/made_mjcf.h"
#include "tests/support/body_robots.h"

namespace dyngen::test {
namespace {

constexpr unsigned kRobots = 100;

/// The robots of robots/ with bodies in place of what their files leave open; without what URDF
/// has no field for.
/// @param rotors  rotor inertia stays
std::vector<RobotFile> robots_with_bodies(bool rotors) {
  std::vector<RobotFile> robots;
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(DYNGEN_SOURCE_DIR "/robots")) {
    if (entry.path().extension() == ".robot") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) {
    RobotFile file = read_robot_file(path.string());
    file.parameters = ParameterMeaning::kBodies;
    file.effects.clear();
    const auto joints = static_cast<std::size_t>(file.joint_count);
    const auto set = [&](RowKey key, std::size_t joint, const GiNaC::ex& value) {
      Row& row = file.rows[static_cast<std::size_t>(key)];
      if (!row.present) row.values.assign(joints, FieldValue{});
      row.present = true;
      row.values[joint].unknown = false;
      row.values[joint].value = value;
    };
    for (std::size_t j = 0; j < joints; ++j) {
      const auto ten = random_body(1995 + 100 * robots.size() + j);
      for (std::size_t k = 0; k < 10; ++k) {
        set(static_cast<RowKey>(static_cast<std::size_t>(RowKey::kXX) + k), j,
            GiNaC::numeric(ten[k]));
      }
      set(RowKey::kIA, j, rotors ? GiNaC::numeric(static_cast<long>(j) + 1, 7L) : 0);
      set(RowKey::kFv, j, GiNaC::numeric(1, 3 + static_cast<long>(j)));
      set(RowKey::kFs, j, 0);
      set(RowKey::kOff, j, 0);
    }
    GiNaC::ex square = 0;
    for (const RowKey key : {RowKey::kGx, RowKey::kGy, RowKey::kGz}) {
      const Row& row = file.row(key);
      if (row.present) square += row.values[0].value * row.values[0].value;
    }
    for (const RowKey key : {RowKey::kGx, RowKey::kGy, RowKey::kGz}) {
      Row& row = file.rows[static_cast<std::size_t>(key)];
      // what URDF's readers take
      if (row.present) row.values[0].value *= GiNaC::numeric(981, 100) / GiNaC::sqrt(square);
    }
    robots.push_back(std::move(file));
  }
  return robots;
}

#ifdef DYNGEN_PEER_KDL_PARSER

ByJoint damping_of(const std::vector<MadeLink>& links) {
  ByJoint result;
  for (const MadeLink& link : links) result[link.joint] = link.damping;
  return result;
}

TEST(Descriptions, KdlHasTheTorquesOfRandomUrdfs) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    const std::string text = urdf_of(links);
    expect_same_torques(OwnRobot(text, "made.urdf"), *kdl_robot(text, damping_of(links)),
                        fmt::format("seed {}", seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Descriptions, KdlHasTheTorquesOfUrdfsThatAreWritten) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    const RobotFile file =
        parse_robot_file(parse_robot(urdf_of(links), "made.urdf").text, "m.robot");
    const std::string text = urdf_text(file, build_model(file)).text;
    expect_same_torques(OwnRobot(urdf_of(links), "made.urdf"), *kdl_robot(text, damping_of(links)),
                        fmt::format("seed {}", seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Descriptions, KdlHasTheTorquesOfTheRobotsOfFiles) {
  for (const RobotFile& file : robots_with_bodies(false)) {
    const WrittenRobot written = urdf_text(file, build_model(file));
    const OwnRobot own(file);
    ByJoint damping;
    const Row& Fv = file.row(RowKey::kFv);
    const RobotModel model = build_model(file);
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      if (model.joints[j].coordinate < 0) continue;
      damping[model.joints[j].name] = GiNaC::ex_to<GiNaC::numeric>(Fv.values[j].value).to_double();
    }
    expect_same_torques(own, *kdl_robot(written.text, damping), file.name);
    expect_same_torques(OwnRobot(written.text, "w.urdf"), *kdl_robot(written.text, damping),
                        file.name);
  }
}

#endif

#ifdef DYNGEN_PEER_MUJOCO

/// The same robot with inertias whose axes are written: nobody has to find them.
std::vector<MadeLink> with_written_axes(std::vector<MadeLink> links) {
  for (MadeLink& link : links) {
    const Eigen::Vector3d moments = link.inertia.diagonal();
    link.inertia = moments.asDiagonal();
    if (link.type == 2) link.mass = 0;
  }
  return links;
}

TEST(Descriptions, MujocoHasTheTorquesOfRandomUrdfs) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    for (const bool written : {true, false}) {
      const std::vector<MadeLink> links = made_robot(seed);
      const std::string text = urdf_of(written ? with_written_axes(links) : links);
      expect_same_torques(OwnRobot(text, "made.urdf"), *mujoco_robot(text, "made.urdf"),
                          fmt::format("seed {}", seed), written ? 1e-9 : kMujocoAxes);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Descriptions, MujocoHasTheTorquesOfRandomMjcf) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    for (const bool one_solid : {true, false}) {
      const std::string text = made_mjcf(seed, one_solid);
      expect_same_torques(OwnRobot(text, "made.xml"), *mujoco_robot(text, "made.xml"),
                          fmt::format("seed {}\n{}", seed, text), one_solid ? 1e-9 : kMujocoAxes);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Descriptions, MujocoHasTheTorquesOfMjcfThatIsWritten) {
  for (unsigned seed = 1; seed <= kRobots; ++seed) {
    const std::vector<MadeLink> links = made_robot(seed);
    const RobotFile file =
        parse_robot_file(parse_robot(urdf_of(links), "made.urdf").text, "m.robot");
    const std::string text = mjcf_text(file, build_model(file)).text;
    expect_same_torques(OwnRobot(urdf_of(links), "made.urdf"), *mujoco_robot(text, "made.xml"),
                        fmt::format("seed {}", seed));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Descriptions, MujocoHasTheTorquesOfTheRobotsOfFiles) {
  for (const RobotFile& file : robots_with_bodies(true)) {
    const std::string text = mjcf_text(file, build_model(file)).text;
    expect_same_torques(OwnRobot(file), *mujoco_robot(text, "w.xml"), file.name);
    expect_same_torques(OwnRobot(text, "w.xml"), *mujoco_robot(text, "w.xml"), file.name);
  }
  for (const RobotFile& file : robots_with_bodies(false)) {
    const std::string text = urdf_text(file, build_model(file)).text;
    expect_same_torques(OwnRobot(file), *mujoco_robot(text, "w.urdf"), file.name, kMujocoAxes);
  }
}

#endif

}  // namespace
}  // namespace dyngen::test
