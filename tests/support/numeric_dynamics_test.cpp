// SPDX-License-Identifier: MIT
//
// Who judges the judge: the numeric dynamics against values that were computed another way.
#include "tests/support/numeric_dynamics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "tests/support/oracle_data.h"
#include "tests/support/relative_error.h"

namespace dyngen::test {
namespace {

// The stored values are doubles, good to 1e-16 of the largest; a double recursion over seven joints
// loses at most some hundreds of roundings more.
constexpr double kTolerance = 1e-12;

template <typename Scalar>
std::vector<Scalar> as(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

template <typename Scalar>
std::vector<Scalar> entries(const SquareMatrix<Scalar>& M) {
  std::vector<Scalar> row_major;
  for (Eigen::Index i = 0; i < M.rows(); ++i) {
    for (Eigen::Index j = 0; j < M.cols(); ++j) row_major.push_back(M(i, j));
  }
  return row_major;
}

/// Error of the whole torque over all states.
template <typename Scalar>
double torque_error(const NumericRobot& robot, const std::vector<OracleState>& states) {
  RelativeError error;
  for (const OracleState& s : states) {
    error.add(id(robot, as<Scalar>(s.q), as<Scalar>(s.dq), as<Scalar>(s.ddq)), s.tau);
  }
  return error.value();
}

template <typename Scalar>
void expect_all_parts(const NumericRobot& robot, const std::vector<OracleState>& states) {
  ASSERT_GE(states.size(), 100U);
  RelativeError rigid, g, c, M, rotor;
  for (const OracleState& s : states) {
    const auto q = as<Scalar>(s.q);
    const auto dq = as<Scalar>(s.dq);
    const auto ddq = as<Scalar>(s.ddq);
    rigid.add(id_rigid(robot, q, dq, ddq), s.tau_rb);
    g.add(gravity(robot, q), s.g);
    c.add(coriolis(robot, q, dq), s.c);
    M.add(entries(rigid_mass_matrix(robot, q)), s.M);
    // tau_nofric - tau = -friction
    std::vector<Scalar> without = id(robot, q, dq, ddq);
    const std::vector<Scalar> f = friction(robot, dq);
    for (std::size_t i = 0; i < f.size(); ++i) without[i] -= f[i];
    rotor.add(without, s.tau_nofric);
  }
  EXPECT_LT(torque_error<Scalar>(robot, states), kTolerance);
  EXPECT_LT(rigid.value(), kTolerance);
  EXPECT_LT(g.value(), kTolerance);
  EXPECT_LT(c.value(), kTolerance);
  EXPECT_LT(M.value(), kTolerance);
  EXPECT_LT(rotor.value(), kTolerance);
}

class NumericDynamicsOracle : public testing::TestWithParam<std::string> {};

TEST_P(NumericDynamicsOracle, DoubleEqualsStoredValues) {
  const Oracle oracle = load_oracle(GetParam());
  expect_all_parts<double>(oracle.robot, oracle.states);
}

TEST_P(NumericDynamicsOracle, LongDoubleEqualsStoredValues) {
  const Oracle oracle = load_oracle(GetParam());
  expect_all_parts<long double>(oracle.robot, oracle.states);
}

class NumericDynamicsBothConventions : public testing::TestWithParam<std::string> {};

TEST_P(NumericDynamicsBothConventions, StandardFramesGiveTheSameTorques) {
  const Oracle oracle = load_oracle(GetParam());
  ASSERT_TRUE(oracle.standard.has_value());
  expect_all_parts<double>(*oracle.standard, oracle.states);
  expect_all_parts<long double>(*oracle.standard, oracle.states);
}

TEST_P(NumericDynamicsOracle, MassMatrixHasRotorInertiaOnItsDiagonal) {
  const Oracle oracle = load_oracle(GetParam());
  const auto q = oracle.states.front().q;
  const SquareMatrix<double> difference =
      mass_matrix(oracle.robot, q) - rigid_mass_matrix(oracle.robot, q);
  for (Eigen::Index i = 0; i < difference.rows(); ++i) {
    for (Eigen::Index j = 0; j < difference.cols(); ++j) {
      const double IA = oracle.robot.joints[static_cast<std::size_t>(i)].IA;
      EXPECT_NEAR(difference(i, j), i == j ? IA : 0, 1e-14);
    }
  }
}

// The comparison must be able to fail: each number that the torque depends on, wrong by 1e-6 of
// itself, has to show above the tolerance.
TEST_P(NumericDynamicsOracle, ComparisonFailsOnAWrongNumber) {
  const Oracle oracle = load_oracle(GetParam());
  const auto error_with = [&](auto change) {
    NumericRobot wrong = oracle.robot;
    change(wrong);
    return torque_error<long double>(wrong, oracle.states);
  };
  const std::size_t last = oracle.robot.size() - 1;
  // What the last joint feels: ZZ of a revolute one, M of a prismatic one.
  const bool standard = oracle.robot.standard;
  const bool prismatic = oracle.robot.joints[last].sigma == 1;
  const std::size_t felt = inertial_place(prismatic ? "M" : "ZZ");
  ASSERT_FALSE(standard && oracle.robot.joints[last].alpha != 0) << "then ZZ is not the felt one";
  const double scale = 1 + 1e-6;
  EXPECT_GT(error_with([&](NumericRobot& r) { r.joints[last].inertial[felt] *= scale; }),
            kTolerance);
  EXPECT_GT(error_with([&](NumericRobot& r) { r.joints[last].Fs *= scale; }), kTolerance);
  EXPECT_GT(error_with([&](NumericRobot& r) { r.joints[last].IA *= scale; }), kTolerance);
  EXPECT_GT(error_with([&](NumericRobot& r) {
              for (double& g : r.base_acceleration) g *= scale;
            }),
            kTolerance);
  EXPECT_GT(error_with([&](NumericRobot& r) { r.joints[last].alpha += 1e-6; }), kTolerance);
}

INSTANTIATE_TEST_SUITE_P(All, NumericDynamicsBothConventions,
                         testing::Values("planar2r", "rp", "scara_rrpr", "stanford", "rx90",
                                         "ur10e", "panda7"),
                         [](const auto& test) { return test.param; });

INSTANTIATE_TEST_SUITE_P(All, NumericDynamicsOracle, testing::ValuesIn(oracle_names()),
                         [](const auto& test) { return test.param; });

TEST(NumericDynamics, ComparisonFailsOnTheWrongConvention) {
  Oracle oracle = load_oracle("rx90");
  oracle.robot.standard = true;
  EXPECT_GT(torque_error<double>(oracle.robot, oracle.states), 1e-3);
}

TEST(NumericDynamics, SarcosGravityEqualsGradientOfThePotential) {
  const NumericRobot robot = load_sarcos();
  const Table table = load_sarcos_gravity();
  ASSERT_EQ(table.rows.size(), 200U);
  RelativeError in_double, in_long_double, wrong;
  NumericRobot changed = robot;
  changed.joints[6].inertial[inertial_place("MY")] *= 1 + 1e-6;
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const auto q = table.slice(k, "q1", 7);
    const auto g = table.slice(k, "g1", 7);
    in_double.add(gravity(robot, q), g);
    in_long_double.add(gravity(robot, as<long double>(q)), g);
    wrong.add(gravity(changed, q), g);
  }
  EXPECT_LT(in_double.value(), kTolerance);
  EXPECT_LT(in_long_double.value(), kTolerance);
  EXPECT_GT(wrong.value(), kTolerance);
}

TEST(NumericDynamics, Puma3TorqueIsRegressorTimesTable71) {
  const NumericRobot robot = load_puma3();
  const NamedValues beta = load_table_7_1();
  const Table table = load_puma3_regressor();
  ASSERT_EQ(table.rows.size(), 100U);
  ASSERT_EQ(beta.names.size(), 15U);
  RelativeError torque, columns;
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    const auto q = table.slice(k, "q1", 3);
    const auto dq = table.slice(k, "qd1", 3);
    const auto ddq = table.slice(k, "qdd1", 3);
    std::vector<double> tau;
    for (const char joint : {'1', '2', '3'}) {
      const auto row = table.slice(k, std::string("Y") + joint + "_ZZ1", 15);
      double sum = 0;
      for (std::size_t p = 0; p < 15; ++p) sum += row[p] * beta.values[p];
      tau.push_back(sum);
    }
    torque.add(id(robot, q, dq, ddq), tau);
    // and column by column
    for (std::size_t p = 0; p < 15; ++p) {
      NumericRobot unit = robot;
      for (NumericJoint& joint : unit.joints) joint.inertial = {};
      const std::string& name = beta.names[p];
      unit.joints[std::stoul(name.substr(2)) - 1].inertial[inertial_place(name.substr(0, 2))] = 1;
      std::vector<double> column;
      for (const char joint : {'1', '2', '3'}) {
        column.push_back(table.slice(k, std::string("Y") + joint + "_" + name, 1).front());
      }
      columns.add(id(unit, q, dq, ddq), column);
    }
  }
  EXPECT_LT(torque.value(), kTolerance);
  EXPECT_LT(columns.value(), kTolerance);
}

// gravload(qn) as the Robotics Toolbox prints it, to its four decimals.
TEST(NumericDynamics, Puma560GravityAtNominalPoseIsTheOneCorkePublished) {
  const NumericRobot robot = load_oracle("puma560_corke_std").robot;
  constexpr double pi = std::numbers::pi;
  const std::vector<double> g = gravity(robot, std::vector<double>{0, pi / 4, pi, 0, pi / 4, 0});
  const std::vector<double> published = {0, 31.6399, 6.0351, 0, 0.0283, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(g[i], published[i], 5e-5);
}

// A fixed joint carries its link along: the same arm as with both links in one.
TEST(NumericDynamics, FixedJointHasNoMotionAndNoTorque) {
  for (const bool standard : {false, true}) {
    NumericRobot arm;
    arm.standard = standard;
    arm.base_acceleration = {0, 9.81, 0};
    NumericJoint joint;
    joint.inertial = {0.1, 0.01, 0.02, 0.2, 0.03, 0.3, 0.4, 0.5, 0.6, 2};
    arm.joints.push_back(joint);
    NumericRobot with_fixed = arm;
    NumericJoint tool;  // frame turned by nothing, moved by 0.5 m along x
    tool.sigma = 2;
    tool.parent = 1;
    tool.d = 0.5;
    tool.inertial[9] = 3;                        // a point mass of 3 kg at its origin
    tool.IA = tool.Fs = tool.Fv = tool.off = 7;  // without meaning here
    with_fixed.joints.push_back(tool);
    auto& merged = arm.joints[0].inertial;
    merged[3] += 3 * 0.5 * 0.5;
    merged[5] += 3 * 0.5 * 0.5;
    merged[6] += 3 * 0.5;
    merged[9] += 3;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto fixed = id<double>(with_fixed, {0.7, nan}, {1.1, nan}, {-2.0, nan});
    const auto plain = id<double>(arm, {0.7}, {1.1}, {-2.0});
    EXPECT_NEAR(fixed[0], plain[0], 1e-13);
    EXPECT_EQ(fixed[1], 0);
    EXPECT_EQ(mass_matrix<double>(with_fixed, {0.7, 0})(1, 1), 0);
  }
}

// Two equal arms on one turntable, seen as a tree: each feels what it feels alone.
TEST(NumericDynamics, BranchesOfATreeActOnlyThroughTheirParent) {
  const NumericRobot serial = load_oracle("rx90").robot;
  NumericRobot tree = serial;
  for (std::size_t i = 1; i < serial.size(); ++i) {
    NumericJoint joint = serial.joints[i];
    joint.parent = i == 1 ? 1 : static_cast<int>(serial.size() + i) - 1;
    tree.joints.push_back(joint);
  }
  const OracleState s = load_oracle("rx90").states.front();
  const auto doubled = [](std::vector<double> v) {
    const std::vector<double> arm(v.begin() + 1, v.end());
    v.insert(v.end(), arm.begin(), arm.end());
    return v;
  };
  const auto tau = id_rigid(tree, doubled(s.q), doubled(s.dq), doubled(s.ddq));
  RelativeError error;
  for (std::size_t i = 1; i < 6; ++i) {
    error.add(tau[i], s.tau_rb[i]);
    error.add(tau[i + 5], s.tau_rb[i]);
  }
  // The turntable carries its own link once and the arm twice.
  NumericRobot bare = serial;
  bare.joints.resize(1);
  const double own = id_rigid<double>(bare, {s.q[0]}, {s.dq[0]}, {s.ddq[0]}).front();
  error.add(tau[0], 2 * s.tau_rb[0] - own);
  EXPECT_LT(error.value(), kTolerance);
}

TEST(NumericDynamics, ForwardKinematicsOfThePlanarArm) {
  const NumericRobot robot = load_oracle("planar2r").robot;
  const auto frames = forward_kinematics<double>(robot, {0.3, 0.4});
  EXPECT_NEAR(frames[1](0, 3), 0.5 * std::cos(0.3), 1e-15);
  EXPECT_NEAR(frames[1](1, 3), 0.5 * std::sin(0.3), 1e-15);
  EXPECT_NEAR(frames[1](0, 0), std::cos(0.7), 1e-15);
  EXPECT_NEAR(frames[1](0, 1), -std::sin(0.7), 1e-15);
}

TEST(NumericDynamics, WrongShapesAreRefused) {
  NumericRobot robot = load_oracle("rp").robot;
  const std::vector<double> two = {0, 0};
  const std::vector<double> one = {0};
  EXPECT_THROW(id(robot, one, two, two), std::invalid_argument);
  EXPECT_THROW(id(robot, two, one, two), std::invalid_argument);
  EXPECT_THROW(id(robot, two, two, one), std::invalid_argument);
  robot.joints[0].parent = 2;
  EXPECT_THROW(id(robot, two, two, two), std::invalid_argument);
  robot.joints[0].parent = 0;
  robot.joints[1].sigma = 3;
  EXPECT_THROW(id(robot, two, two, two), std::invalid_argument);
}

TEST(RelativeError, DoesNotPassByAccident) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto error = [](const std::vector<double>& a, const std::vector<double>& b) {
    return relative_error(a, b);
  };
  EXPECT_DOUBLE_EQ(error({1, 2}, {1, 4}), 0.5);
  EXPECT_EQ(error({0}, {0}), 0);
  EXPECT_TRUE(std::isinf(error({}, {})));
  EXPECT_TRUE(std::isinf(error({1, 2}, {1})));
  EXPECT_TRUE(std::isinf(error({nan}, {1})));
  EXPECT_TRUE(std::isinf(error({1}, {nan})));
  EXPECT_TRUE(std::isinf(error({1e-30}, {0})));
}

}  // namespace
}  // namespace dyngen::test
