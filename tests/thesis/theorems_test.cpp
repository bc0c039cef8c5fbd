// SPDX-License-Identifier: MIT
// What the thesis proves of base parameters (chapters 2 and 3), held against the closed form.
// Theorem 2 is a route of its own: tests/gen/base_routes_test.cpp.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "gen/base_parameters/base_parameters.h"
#include "gen/symbols/exact.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_dynamics.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

using GiNaC::ex;
using Inertial = std::array<ex, kInertialCount>;

/// l_i: where frame i's origin stands in frame i - 1.
std::array<ex, 3> link_vector(const SymbolicLink& link) {
  return {link.d, -link.r * exact_sin(link.alpha), link.r * exact_cos(link.alpha)};
}

/// What Theorem 1 adds to link i for a mass m of link i + 1, with l in place of its l_{i+1}.
Inertial theorem_1(const ex& m, const std::array<ex, 3>& l) {
  const ex square = l[0] * l[0] + l[1] * l[1] + l[2] * l[2];
  return {m * (square - l[0] * l[0]),
          -m * l[0] * l[1],
          -m * l[0] * l[2],
          m * (square - l[1] * l[1]),
          -m * l[1] * l[2],
          m * (square - l[2] * l[2]),
          m * l[0],
          m * l[1],
          m * l[2],
          m};
}

/// Four revolute joints in no special position.
constexpr const char* kGeneralArm = R"(
number_link 4
al 0.2 pi/2 -0.7 pi/3
d 0.1 0.3 0.25 -0.4
r 0.2 -0.15 0.35 0.22
th 0 0.4 0 1.1
m 2 3 1.5 0.8
mX 0.1 0.2 -0.3 0.05
mY 0.3 -0.1 0.2 0.07
mZ -0.2 0.15 0.1 0.02
XX 0.5 0.4 0.3 0.2
YY 0.4 0.5 0.2 0.1
ZZ 0.6 0.3 0.4 0.1
gx 1
gy -2
gz 9.81
stop
)";

TEST(Theorem1, IsTheClosedFormOfAMassAlone) {
  const SymbolicRobot robot = make_symbolic(parse_model(kGeneralArm));
  for (int i = 1; i < robot.size(); ++i) {
    const SymbolicLink& next = robot.link(i + 1);
    Inertial mass_alone;
    mass_alone.fill(0);
    const ex m = next.chi[index(Chi::kM)];
    mass_alone[index(Chi::kM)] = m;
    const Inertial moved = move_to_parent(mass_alone, next.alpha, next.d, 0, next.r);
    const Inertial augmented = theorem_1(m, link_vector(next));
    for (std::size_t k = 0; k < kInertialCount; ++k) {
      EXPECT_TRUE(drop_rounding(moved[k] - augmented[k]).is_zero())
          << chi_name(static_cast<Chi>(k), i) << ": " << moved[k] << ", " << augmented[k];
    }
  }
}

TEST(Theorem1, StandsInTheRegroupingFormulas) {
  const SymbolicRobot robot =
      make_symbolic(with_unknown_parameters(parse_model(kGeneralArm), true));
  const ex M4 = robot.link(4).chi[index(Chi::kM)];
  const Inertial augmented = theorem_1(1, link_vector(robot.link(4)));
  // link 3 of a revolute joint keeps XX - YY and loses YY, MZ and M to link 2
  std::array<ex, kInertialCount> wanted = augmented;
  wanted[index(Chi::kXX)] -= augmented[index(Chi::kYY)];
  int compared = 0;
  for (const GroupedParameter& parameter : regroup(robot).parameters) {
    if (parameter.column.link != 3) continue;
    const ex coefficient = parameter.value.expand().coeff(M4);
    EXPECT_TRUE(drop_rounding(coefficient - wanted[index(parameter.column.kind)]).is_zero())
        << parameter.name();
    ++compared;
  }
  EXPECT_EQ(compared, 7);
}

/// The error of the torques when the mass of link i + 1 is moved to link i.
double error_of_moving_mass(int i, bool as_printed) {
  const RobotModel model = parse_model(kGeneralArm);
  const SymbolicRobot robot = make_symbolic(model);
  const NumericRobot before = numeric_robot(model);
  NumericRobot after = before;
  NumericJoint& own = after.joints[static_cast<std::size_t>(i - 1)];
  NumericJoint& next = after.joints[static_cast<std::size_t>(i)];
  const double m = next.inertial[index(Chi::kM)];
  const Inertial right = theorem_1(m, link_vector(robot.link(i + 1)));
  // the print takes l_i for the tensor and l_{i+1} for the first moments
  const Inertial printed = theorem_1(m, link_vector(robot.link(i)));
  for (std::size_t k = 0; k < kInertialCount; ++k) {
    own.inertial[k] += to_double(as_printed && k < index(Chi::kMX) ? printed[k] : right[k]);
  }
  next.inertial[index(Chi::kM)] = 0;
  RelativeError error;
  for (const MotionSample& sample : random_samples(4, 20, 3)) {
    error.add(id(after, sample.q, sample.dq, sample.ddq),
              id(before, sample.q, sample.dq, sample.ddq));
  }
  return error.value();
}

TEST(Theorem1, ChangesNoTorqueWithTheVectorOfTheNextLink) {
  for (const int i : {1, 2, 3}) EXPECT_LT(error_of_moving_mass(i, false), 1e-13) << i;
}

TEST(Theorem1, IsWrongAsPrintedWithTheVectorOfTheLinkItself) {
  for (const int i : {1, 2, 3}) EXPECT_GT(error_of_moving_mass(i, true), 1e-4) << i;
}

/// An arm of parallel and perpendicular axes in general position: no length is zero.
RobotModel parallel_perpendicular_arm(std::mt19937_64& random, int joints, bool gravity_along) {
  NumericRobot robot;
  const double right_angle = 1.5707963267948966;
  std::uniform_int_distribution<int> quarter(0, 3), length(100, 700);
  for (int j = 1; j <= joints; ++j) {
    NumericJoint joint;
    joint.parent = j - 1;
    joint.alpha = j == 1 ? 0 : right_angle * quarter(random);
    joint.theta = right_angle * quarter(random);
    joint.d = length(random) / 1000.0;
    joint.r = length(random) / 1000.0;
    robot.joints.push_back(joint);
  }
  robot.base_acceleration = {gravity_along ? 0.0 : 3.0, gravity_along ? 0.0 : -5.0, 9.81};
  return robot_model(robot);
}

/// Mayeda's set (thesis, chapter 2): ZZ MX MY of every link, XX XY XZ YZ from the second cluster of
/// parallel axes on. Where gravity is along the first axis MX1 and MY1 are not in it: the thesis's
/// statement leaves this case out, its Appendix A has it so.
std::set<std::string> mayeda_set(const RobotModel& model, bool gravity_along) {
  std::set<std::string> names;
  bool first_cluster = true;
  for (int j = 1; j <= model.size(); ++j) {
    if (j > 1 && !is_zero_number(exact_sin(model.joint(j).alpha))) first_cluster = false;
    std::vector<Chi> kinds = {Chi::kZZ};
    if (j > 1 || !gravity_along) kinds.insert(kinds.end(), {Chi::kMX, Chi::kMY});
    if (!first_cluster) kinds.insert(kinds.end(), {Chi::kXX, Chi::kXY, Chi::kXZ, Chi::kYZ});
    for (const Chi kind : kinds) names.insert(chi_name(kind, j));
  }
  return names;
}

TEST(MayedaSet, ComesOutForArmsOfParallelAndPerpendicularAxes) {
  std::mt19937_64 random(90);
  std::set<std::size_t> sizes;
  for (int arm = 0; arm < 40; ++arm) {
    const bool gravity_along = arm % 2 == 0;
    const RobotModel model = with_unknown_parameters(
        parallel_perpendicular_arm(random, 2 + arm % 6, gravity_along), true);
    std::set<std::string> names;
    for (const GroupedParameter& parameter : regroup(make_symbolic(model)).parameters) {
      names.insert(chi_name(parameter.column.kind, parameter.column.link));
    }
    EXPECT_EQ(names, mayeda_set(model, gravity_along)) << "arm " << arm;
    sizes.insert(names.size());
  }
  EXPECT_GT(sizes.size(), 10u);  // arms of many kinds
}

TEST(MayedaSet, IsThatOfTheRobotsInTheFiles) {
  for (const std::string name : {"puma560_3dof", "puma560", "rx90", "ur10e", "panda"}) {
    const RobotModel model = with_unknown_parameters(read_model("robots/" + name + ".robot"), true);
    std::set<std::string> names;
    for (const GroupedParameter& parameter : regroup(make_symbolic(model)).parameters) {
      names.insert(chi_name(parameter.column.kind, parameter.column.link));
    }
    EXPECT_EQ(names, mayeda_set(model, true)) << name;
  }
}

}  // namespace
}  // namespace dyngen::test
