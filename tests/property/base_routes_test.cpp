// SPDX-License-Identifier: MIT
// Three routes to the base parameters - closed form with certified dependencies, coefficients of
// accelerations and gravity, ranks of random regressor rows - must give the same set.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "gen/base_parameters/base_forms.h"
#include "gen/base_parameters/base_parameters.h"
#include "tests/support/model_bridge.h"
#include "tests/support/oracle_data.h"

namespace dyngen::test::base_routes_tests {
namespace {

/// Every inertial parameter and rotor inertia a symbol of its own, in the modified frames.
SymbolicRobot with_all_parameters(SymbolicRobot robot) {
  for (int j = 1; j <= robot.size(); ++j) {
    SymbolicLink& link = robot.link(j);
    for (std::size_t k = 0; k < kChiCount; ++k) {
      const Chi kind = static_cast<Chi>(k);
      const bool rotor = kind == Chi::kIA && link.type != JointType::kFixed;
      link.chi[k] =
          k < kInertialCount || rotor ? GiNaC::ex(GiNaC::symbol(chi_name(kind, j))) : GiNaC::ex(0);
    }
  }
  return robot;
}

std::string description(const BaseForms& forms) {
  std::string text = std::to_string(forms.forms.rank()) + ":";
  for (const std::size_t pivot : forms.forms.pivots) {
    text += " " + chi_name(forms.columns[pivot].kind, forms.columns[pivot].link);
  }
  return text;
}

/// All routes, for the inverse dynamics and for gravity alone.
void expect_routes_agree(const RobotModel& model, const std::string& name) {
  const SymbolicRobot robot = with_all_parameters(make_symbolic(model));
  const GiNaC::exmap lengths = random_lengths(robot, 99);
  const std::vector<Column> columns = inertial_columns(robot);
  for (const Motions motions : {Motions::kAll, Motions::kStanding}) {
    const Regrouping grouping = regroup(robot, motions);
    EXPECT_TRUE(grouping.unsolved.empty())
        << name << ": " << chi_name(grouping.unsolved[0].kind, grouping.unsolved[0].link);
    const BaseForms closed = grouped_forms(grouping, robot, lengths, columns);
    const BaseForms coefficients = coefficient_forms(robot, lengths, columns, motions);
    const BaseForms numeric = numeric_forms(robot, lengths, columns, motions);
    EXPECT_EQ(grouping.parameters.size(), closed.forms.rank()) << name;
    EXPECT_TRUE(same_space(closed, coefficients)) << name << "\n"
                                                  << description(closed) << "\n"
                                                  << description(coefficients);
    EXPECT_TRUE(same_space(numeric, coefficients)) << name << "\n"
                                                   << description(numeric) << "\n"
                                                   << description(coefficients);
  }
}

RobotModel with_unknown_lengths(RobotModel model) {
  for (JointModel& joint : model.joints) {
    if (!joint.d.known_zero()) joint.d.unknown = true;
    if (!joint.r.known_zero()) joint.r.unknown = true;
  }
  return model;
}

const std::vector<std::string>& robot_files() {
  static const std::vector<std::string> files = {"robots/kuka_iiwa14.robot",
                                                 "robots/panda.robot",
                                                 "robots/planar2r.robot",
                                                 "robots/puma560.robot",
                                                 "robots/puma560_3dof.robot",
                                                 "robots/rx90.robot",
                                                 "robots/sarcos_grla.robot",
                                                 "robots/scara.robot",
                                                 "robots/stanford.robot",
                                                 "robots/tx40.robot",
                                                 "robots/ur10e.robot",
                                                 "tests/robots/flip3r.robot",
                                                 "tests/robots/odd_angles.robot",
                                                 "tests/robots/panda7_oracle.robot",
                                                 "tests/robots/pendulum.robot",
                                                 "tests/robots/puma560_corke_std.robot",
                                                 "tests/robots/rp.robot",
                                                 "tests/robots/ur10e_oracle.robot"};
  return files;
}

TEST(BaseRoutes, AgreeOnEveryRobotFile) {
  for (const std::string& file : robot_files()) expect_routes_agree(read_model(file), file);
}

TEST(BaseRoutes, AgreeOnEveryRobotFileWithLengthsAtRunTime) {
  for (const std::string& file : robot_files()) {
    expect_routes_agree(with_unknown_lengths(read_model(file)), file + " with run-time lengths");
  }
}

TEST(BaseRoutes, AgreeOnEveryOracle) {
  for (const std::string& name : oracle_names()) {
    const Oracle oracle = load_oracle(name);
    expect_routes_agree(robot_model(oracle.robot), name);
    if (oracle.standard) expect_routes_agree(robot_model(*oracle.standard), name + ", standard");
  }
}

/// Robots with what geometry can do: zero and equal lengths, right, straight and other angles,
/// trees, prismatic and fixed joints, both conventions, gravity along an axis, or none.
RobotModel random_robot(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto pick = [&](int count) {
    return static_cast<int>(random() % static_cast<unsigned>(count));
  };
  const double pi = std::acos(-1.0);
  const std::array<double, 8> angles = {0, 0, pi / 2, pi / 2, -pi / 2, pi, pi / 3, 0.7};
  const std::array<double, 6> lengths = {0, 0, 0, 0.3, 0.3, 0.47};
  const std::array<double, 4> gravities = {0, 0, 9.81, -3.5};
  NumericRobot robot;
  robot.standard = pick(4) == 0;
  const int joints = 1 + pick(7);
  const bool tree = pick(3) == 0;
  for (int j = 1; j <= joints; ++j) {
    NumericJoint joint;
    const int kind = pick(10);
    joint.sigma = kind < 6 ? 0 : kind < 9 ? 1 : 2;
    if (j == joints && kind == 9) joint.sigma = 0;  // something must move
    joint.parent = tree ? pick(j) : j - 1;
    joint.alpha = angles[static_cast<std::size_t>(pick(8))];
    joint.theta = pick(2) == 0 ? 0 : angles[static_cast<std::size_t>(pick(8))];
    joint.d = lengths[static_cast<std::size_t>(pick(6))];
    joint.r = lengths[static_cast<std::size_t>(pick(6))];
    robot.joints.push_back(joint);
  }
  for (double& component : robot.base_acceleration) {
    component = gravities[static_cast<std::size_t>(pick(4))];
  }
  return robot_model(robot);
}

TEST(BaseRoutes, AgreeOnRandomRobots) {
  for (std::uint64_t seed = 1; seed <= 80; ++seed) {
    expect_routes_agree(random_robot(seed), "seed " + std::to_string(seed));
  }
}

TEST(BaseRoutes, AgreeOnRandomRobotsWithLengthsAtRunTime) {
  for (std::uint64_t seed = 1001; seed <= 1080; ++seed) {
    RobotModel model = with_unknown_lengths(random_robot(seed));
    std::mt19937_64 random(seed);
    for (JointModel& joint : model.joints) {  // some stay numbers
      if (random() % 3 == 0) joint.d.unknown = false;
      if (random() % 3 == 0) joint.r.unknown = false;
    }
    for (Quantity& component : model.gravity) component.unknown = random() % 3 == 0;
    expect_routes_agree(model, "seed " + std::to_string(seed) + " with run-time lengths");
  }
}

}  // namespace
}  // namespace dyngen::test::base_routes_tests
