// SPDX-License-Identifier: MIT
// What is added to real recordings, on motions that are known.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/blind/real/added_torque.h"
#include "tests/blind/real/shown.h"
#include "tests/support/numeric_dynamics.h"

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

std::string temporary(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("blind_real_" + name)).string();
}

/// The pendulum in a smooth motion, with torque of links, friction and noise.
RealMotion pendulum(double phase, double deviation) {
  const RealRobot robot = real_robot("dfki");
  dyngen::test::NumericRobot whole = robot.bodies;
  whole.joints[0].inertial = {0, 0, 0, 0, 0, 0.03, 0.15, 0, 0, 0.6};
  whole.joints[1].inertial = {0, 0, 0, 0, 0, 0.02, 0.1, 0.02, 0, 0.5};
  whole.joints[0].Fs = whole.joints[1].Fs = 0.1;
  whole.joints[0].Fv = whole.joints[1].Fv = 0.02;
  const Index n = 4000;
  RealMotion motion;
  motion.t = VectorXd::LinSpaced(n, 0, 10);
  motion.q = motion.dq = motion.ddq = motion.tau = MatrixXd::Zero(n, 2);
  Random random(7);
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < 2; ++j) {
      for (const double w : {1.3, 3.1 + static_cast<double>(j)}) {
        const double u = w * motion.t[k] + phase + static_cast<double>(j);
        motion.q(k, j) += 0.6 * std::sin(u);
        motion.dq(k, j) += 0.6 * w * std::cos(u);
        motion.ddq(k, j) -= 0.6 * w * w * std::sin(u);
      }
    }
    const auto row = [k](const MatrixXd& m) { return std::vector<double>{m(k, 0), m(k, 1)}; };
    const auto tau = dyngen::test::id(whole, row(motion.q), row(motion.dq), row(motion.ddq));
    for (Index j = 0; j < 2; ++j) {
      motion.tau(k, j) = tau[static_cast<std::size_t>(j)] + deviation * random.normal();
    }
  }
  return motion;
}

TEST(RealTable, KeepsTheLettersOfWhatIsNotChanged) {
  const std::string path = temporary("table.csv"), written = temporary("written.csv");
  std::ofstream(path) << "time,q1,tau1,tau2\n0.0000,1.50e-01,2.0,3.00\n0.0010,-0.0,2.50,-4\n";
  Table table = Table::read(path);
  MatrixXd tau = table.by_joint("tau");
  EXPECT_EQ(tau(1, 1), -4);
  tau(0, 0) += 0.125;
  table.set_by_joint("tau", tau);
  table.write(written);
  std::stringstream text;
  text << std::ifstream(written).rdbuf();
  EXPECT_EQ(text.str(), "time,q1,tau1,tau2\n0.0000,1.50e-01,2.125,3.00\n0.0010,-0.0,2.50,-4\n");
  std::ofstream(path) << "time,q1,tau1\n0,1,2\n0,1\n";
  EXPECT_THAT([&] { Table::read(path); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::HasSubstr(":3: found 2 values, expected 3")));
}

TEST(RealMotion, IsThatOfTheRecordingAtUnevenTimes) {
  const std::string path = temporary("motion.csv");
  std::ofstream file(path);
  file << "time,q1,tau1\n";
  Random random(3);
  double t = 5;
  std::vector<double> times;
  for (int k = 0; k < 3000; ++k, t += random.between(0.0015, 0.0025)) {
    times.push_back(t - 5);
    file << t - 0 << "," << std::sin(3 * (t - 5)) << ",1\n";
  }
  file.close();
  const RealMotion motion = motion_of(Table::read(path), 0.04);
  for (Index k = 50; k < 2950; k += 50) {
    EXPECT_NEAR(motion.q(k, 0), std::sin(3 * motion.t[k]), 1e-4);
    EXPECT_NEAR(motion.dq(k, 0), 3 * std::cos(3 * motion.t[k]), 1e-2);
    EXPECT_NEAR(motion.ddq(k, 0), -9 * std::sin(3 * motion.t[k]), 0.5);
  }
}

TEST(RealRobot, HoldsAForceAsItHoldsAWeight) {
  for (const char* name : {"tx40", "dfki"}) {
    RealRobot robot = real_robot(name);
    const auto joints = static_cast<Index>(robot.bodies.size());
    VectorXd q(joints);
    for (Index j = 0; j < joints; ++j) q[j] = 0.3 + 0.4 * static_cast<double>(j);
    const Vector3d at(0.1, -0.05, 0.2);
    const Vector3d up(robot.bodies.base_acceleration.data());
    const std::vector<double> still(robot.bodies.size(), 0.0);
    for (Index link = 0; link < joints; ++link) {
      dyngen::test::NumericRobot loaded = robot.bodies;
      auto& inertial = loaded.joints[static_cast<std::size_t>(link)].inertial;
      inertial = {0, 0, 0, 0, 0, 0, 2 * at.x(), 2 * at.y(), 2 * at.z(), 2};
      const auto held =
          dyngen::test::id_rigid(loaded, std::vector<double>(q.begin(), q.end()), still, still);
      const VectorXd torque = torque_of_force(robot, q, link, at, 2 * up);
      for (Index j = 0; j < joints; ++j) {
        EXPECT_NEAR(torque[j], held[static_cast<std::size_t>(j)], 1e-12) << name << " " << link;
      }
    }
  }
}

TEST(Shown, WhatTheModelHasIsAbsorbedAndARippleIsNot) {
  const RealRobot robot = real_robot("dfki");
  const std::vector<RealMotion> motions = {pendulum(0, 0.02), pendulum(2, 0.02)};
  const Shown shown(robot, motions);
  std::vector<MatrixXd> viscous, ripple;
  for (const RealMotion& motion : motions) {
    viscous.emplace_back(motion.dq * 0.1);
    MatrixXd wave = MatrixXd::Zero(motion.samples(), 2);
    wave.col(0) = 0.05 * (9 * motion.q.col(0)).array().sin();
    ripple.push_back(wave);
  }
  EXPECT_GT(shown.absorbed(viscous), 1 - 1e-6);
  EXPECT_LT(shown.absorbed(ripple), 0.3);
  const double once = shown.squares(ripple);
  for (MatrixXd& each : ripple) each *= 3;
  EXPECT_NEAR(shown.squares(ripple), 9 * once, 1e-6 * once);
  // white noise of 0.02 at 400 Hz behind a mean of 8 samples and more: squares of 0.05 sin
  const double rows = 2 * 10 * 50, expected = rows * 0.5 * 0.05 * 0.05 / (0.02 * 0.02 / 10.7);
  EXPECT_NEAR(once / expected, 1, 0.5);
  for (const double dry : shown.dry()) EXPECT_NEAR(dry, 0.1, 0.01);
}

TEST(AddedTorque, OfEveryFamilyActsWhereItSays) {
  const RealRobot robot = real_robot("dfki");
  const RealMotion motion = pendulum(0, 0);
  const Shown shown(robot, {motion});
  const Ground ground{motion, shown.load(motion), 0};
  const std::vector<JointUse> uses(2, JointUse{-1.2, 1.2, 2.5, 0.1, 4});
  for (const char* family :
       {"stribeck", "nonlinear_viscous", "position_friction", "load_friction", "presliding",
        "torque_ripple", "torque_gain", "time_delay", "sensor_drift", "cable", "gravity_spring",
        "contact", "payload_change", "joint_coupling"}) {
    const AddedTorque added = draw_torque(family, robot, uses, 1, 1, 10, Random(5));
    const MatrixXd torque = added.torque(added.typical, ground);
    ASSERT_EQ(torque.rows(), motion.samples()) << family;
    EXPECT_TRUE(torque.allFinite()) << family;
    EXPECT_GT(torque.col(1).norm(), 0) << family;
    const bool both =
        std::string("contact payload_change joint_coupling").find(family) != std::string::npos;
    EXPECT_EQ(torque.col(0).norm() > 0, both) << family;
    EXPECT_EQ(added.family, family);
  }
  EXPECT_THROW(draw_torque("magic", robot, uses, 1, 1, 10, Random(5)), std::invalid_argument);
}

TEST(AddedTorque, FrictionIsAgainstTheMotionOrLess) {
  const RealRobot robot = real_robot("dfki");
  const RealMotion motion = pendulum(0, 0);
  const Shown shown(robot, {motion});
  const Ground ground{motion, shown.load(motion), 0};
  const std::vector<JointUse> uses(2, JointUse{-1.2, 1.2, 2.5, 0.1, 4});
  // pre-sliding takes at most what dry friction gives: together they never push
  const AddedTorque soft = draw_torque("presliding", robot, uses, 0, 1, 10, Random(5));
  const MatrixXd torque = soft.torque(0.1, ground);
  for (Index k = 0; k < motion.samples(); ++k) {
    const double way = motion.dq(k, 0) > 0 ? 1 : -1;
    EXPECT_GE(way * (0.1 * way + torque(k, 0)), 0);
    EXPECT_LE(way * torque(k, 0), 0);
  }
}

}  // namespace
}  // namespace blind
