// SPDX-License-Identifier: MIT
#include "runtime/simulation/plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/runtime/simulation/simulated_arms.h"
#include "tests/support/numeric_plant.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

VectorXd one(double value) { return VectorXd::Constant(1, value); }

TorqueSource constant(double force) {
  return [force](double, const double*, const double*, double* tau) { tau[0] = force; };
}
TorqueSource none(int joints) {
  return [joints](double, const double*, const double*, double* tau) {
    std::fill_n(tau, joints, 0.0);
  };
}

Plant slide(double q, double dq) {
  return {test::numeric_plant(test::slide()), {}, one(q), one(dq)};
}

TEST(Plant, AFreeSwingKeepsItsEnergy) {
  const test::NumericRobot robot = test::without_friction(test::planar_arm());
  Plant plant(test::numeric_plant(robot), {}, Eigen::Vector3d(0.5, -1, 2), VectorXd::Zero(3));
  const double before = test::energy(robot, plant.q(), plant.dq());
  plant.advance(none(3), 5);
  const double kinetic = test::energy(robot, plant.q(), plant.dq()) -
                         test::energy(robot, plant.q(), VectorXd::Zero(3));
  EXPECT_GT(kinetic, 1);
  EXPECT_NEAR(test::energy(robot, plant.q(), plant.dq()), before, 1e-7 * std::abs(before));
}

TEST(Plant, ASlidingMassStopsWhereTheBookSays) {
  // a = -Fs / m = -1.5 m/s^2 from 3 m/s: it stops after 2 s and 3 m, and stays there.
  Plant plant = slide(0, 3);
  plant.advance(constant(0), 1);
  EXPECT_NEAR(plant.dq()[0], 1.5, 1e-9);
  plant.advance(constant(0), 5);
  EXPECT_NEAR(plant.q()[0], 3, 1e-9);
  EXPECT_EQ(plant.dq()[0], 0);
  EXPECT_EQ(plant.counts().reversals, 1);
  EXPECT_NEAR(plant.stuck_time()[0], 3, 1e-9);
}

TEST(Plant, AStuckJointDoesNotMoveInASingleBit) {
  Plant plant = slide(0.1, 0);
  for (int k = 1; k <= 1000; ++k) {
    plant.advance(constant(k % 2 == 0 ? 3 : -2.9), 0.001 * k);
    ASSERT_EQ(plant.q()[0], 0.1);
    ASSERT_EQ(plant.dq()[0], 0);
  }
  EXPECT_NEAR(plant.stuck_time()[0], 1, 1e-12);
  EXPECT_EQ(plant.acceleration(one(3))[0], 0);
  EXPECT_NEAR(plant.acceleration(one(5))[0], 1, 1e-12);
}

TEST(Plant, AStuckJointSlidesWhenItIsPushed) {
  Plant plant = slide(0, 0);
  plant.advance(constant(2.99), 1);
  EXPECT_EQ(plant.q()[0], 0);
  plant.advance(constant(5), 2);  // (5 - 3) / 2 = 1 m/s^2 for 1 s
  EXPECT_NEAR(plant.q()[0], 0.5, 1e-9);
  EXPECT_NEAR(plant.dq()[0], 1, 1e-9);
}

TEST(Plant, TheMomentOfSlidingIsLocated) {
  // The force grows as t: it begins to slide at 3 s; then m a = t - 3.
  Plant plant = slide(0, 0);
  plant.advance([](double t, const double*, const double*, double* tau) { tau[0] = t; }, 5);
  EXPECT_EQ(plant.counts().releases, 1);
  EXPECT_NEAR(plant.stuck_time()[0], 3, 1e-8);
  EXPECT_NEAR(plant.q()[0], 8.0 / 12, 1e-7);
}

TEST(Plant, ADrivenMassSticksAndSlides) {
  // 4 sin(t) against 3: it begins to slide when sin(t) = 3/4, and stops again in every half turn.
  Plant plant = slide(0, 0);
  plant.advance(
      [](double t, const double*, const double*, double* tau) { tau[0] = 4 * std::sin(t); },
      2 * std::numbers::pi);
  EXPECT_EQ(plant.counts().releases, 2);
  EXPECT_EQ(plant.counts().reversals, 2);
  const double first = std::asin(0.75);
  // v(t) = (4 (cos(first) - cos(t)) - 3 (t - first)) / 2 is zero again at `stop`
  double low = first + 0.5, high = std::numbers::pi;
  for (int k = 0; k < 60; ++k) {
    const double t = (low + high) / 2;
    (4 * (std::cos(first) - std::cos(t)) - 3 * (t - first) > 0 ? low : high) = t;
  }
  EXPECT_NEAR(plant.stuck_time()[0], 2 * std::numbers::pi - 2 * (low - first), 1e-7);
  EXPECT_NEAR(plant.q()[0], 0, 1e-9);  // as far back as it went
}

TEST(Plant, SeveralJointsStopAndStay) {
  const test::NumericRobot robot = test::planar_arm();
  Plant plant(test::numeric_plant(robot), {}, Eigen::Vector3d(-1.4, 0.5, -0.3),
              Eigen::Vector3d(1, -2, 3));
  plant.advance(none(3), 30);
  EXPECT_TRUE(plant.dq().isZero(0));
  const VectorXd before = plant.q();
  plant.advance(none(3), 40);
  EXPECT_EQ(plant.q(), before);  // what holds it is friction: it does not hang straight down
  EXPECT_GT((before - Eigen::Vector3d(-std::numbers::pi / 2, 0, 0)).norm(), 1e-3);
}

TEST(Plant, FrictionTakesAsMuchEnergyAsItsWork) {
  // dE/dt = -dq . friction, integrated beside by the trapezoidal rule.
  test::NumericRobot robot = test::planar_arm();
  for (test::NumericJoint& joint : robot.joints) joint.off = 0;
  const PlantModel model = test::numeric_plant(robot);
  Plant plant(model, {}, Eigen::Vector3d(0, 0.5, 0.5), VectorXd::Zero(3));
  const double before = test::energy(robot, plant.q(), plant.dq());
  double lost = 0;
  VectorXd friction(3);
  const auto power = [&] {
    model.friction(plant.dq().data(), friction.data());
    return plant.dq().dot(friction);
  };
  const double h = 1e-4;
  for (int k = 1; k <= 10000; ++k) {
    const double left = power();
    plant.advance(none(3), k * h);
    lost += h * (left + power()) / 2;
  }
  EXPECT_GT(lost, 5);
  EXPECT_NEAR(test::energy(robot, plant.q(), plant.dq()), before - lost, 1e-4 * lost);
}

TEST(Plant, ATighterToleranceAgrees) {
  const test::NumericRobot robot = test::planar_arm();
  const auto end = [&](double tolerance) {
    Plant plant(test::numeric_plant(robot), {.tolerance = tolerance}, Eigen::Vector3d(0, 1, 1),
                VectorXd::Zero(3));
    plant.advance(none(3), 1.5);
    return plant.q();
  };
  EXPECT_LT((end(1e-9) - end(1e-12)).norm(), 1e-6);
  EXPECT_GT((end(1e-3) - end(1e-12)).norm(), 1e-9);
}

TEST(Plant, RefusesWhatItCannotSimulate) {
  const PlantModel model = test::numeric_plant(test::slide());
  EXPECT_THROW(Plant(model, {}, VectorXd::Zero(2), one(0)), std::invalid_argument);
  EXPECT_THROW(Plant(model, {.tolerance = 0}, one(0), one(0)), std::invalid_argument);
  PlantModel broken = model;
  broken.forward = nullptr;
  EXPECT_THROW(Plant(broken, {}, one(0), one(0)), std::invalid_argument);
  broken = model;
  broken.coulomb = one(-1);
  EXPECT_THROW(Plant(broken, {}, one(0), one(0)), std::invalid_argument);
  Plant plant = slide(0, 1);
  EXPECT_THROW(plant.advance(constant(std::nan("")), 1), std::runtime_error);
}

}  // namespace
}  // namespace dyngen::runtime
