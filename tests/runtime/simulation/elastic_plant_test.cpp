// SPDX-License-Identifier: MIT
#include "runtime/simulation/elastic_plant.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "runtime/control/gains.h"
#include "runtime/simulation/closed_loop.h"
#include "tests/runtime/simulation/simulated_arms.h"
#include "tests/support/numeric_plant.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

JointSpring spring(double c) {
  return {[c](double load) { return Twist{c * load, c}; }, c / 1000};
}

TorqueSource none() {
  return [](double, const double*, const double*, double*) {};
}

/// A rotor of 1 kg and a link of 2 kg on a slide, with a spring of 1000 N/m between.
PlantModel two_masses(double friction) {
  test::NumericRobot robot = test::slide();
  robot.joints[0].IA = 1;
  robot.joints[0].Fs = friction;
  return elastic_plant(test::numeric_plant(robot), {{0, 1, 2, spring(1e-3)}});
}

TEST(ElasticPlant, TwoMassesSwingAsTheBookSays) {
  Plant plant(two_masses(0), {}, Eigen::Vector2d(0.03, 0), Eigen::Vector2d(0.2, 0.2));
  const double mass = 2.0 / 3, k = 1000, d = 2 * kGearDamping * std::sqrt(k * 2);
  const double decay = d / (2 * mass), w = std::sqrt(k / mass - decay * decay);
  for (int step = 1; step <= 40; ++step) {
    const double t = 0.05 * step;
    plant.advance(none(), t);
    const double twist =
        0.03 * std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
    EXPECT_NEAR(plant.q()[0] - plant.q()[1], twist, 1e-9) << t;
    EXPECT_NEAR((plant.q()[0] + 2 * plant.q()[1]) / 3, 0.01 + 0.2 * t, 1e-10) << t;
  }
}

TEST(ElasticPlant, ALinkSwingsOnADriveThatFrictionHolds) {
  Plant plant(two_masses(100), {}, Eigen::Vector2d(0, 0.05), Eigen::Vector2d(0, 0));
  const double k = 1000, w = std::sqrt(k / 2), decay = kGearDamping * w;
  const double damped = w * std::sqrt(1 - kGearDamping * kGearDamping);
  for (int step = 1; step <= 20; ++step) {
    const double t = 0.05 * step;
    plant.advance(none(), t);
    EXPECT_EQ(plant.q()[0], 0);
    EXPECT_NEAR(plant.q()[1],
                0.05 * std::exp(-decay * t) *
                    (std::cos(damped * t) + decay / damped * std::sin(damped * t)),
                1e-9);
  }
  EXPECT_NEAR(plant.stuck_time()[0], 1, 1e-9);
  EXPECT_EQ(plant.stuck_time()[1], 0);
}

/// Joints 1 and 3 of the arm have gears that give.
struct ElasticArm {
  ElasticArm() {
    robot = test::without_friction(test::planar_arm());
    links = robot;
    for (const Index j : {Index{0}, Index{2}}) links.joints[static_cast<std::size_t>(j)].IA = 0;
    plant = elastic_plant(test::numeric_plant(robot), {{0, robot.joints[0].IA, 1.5, spring(2e-3)},
                                                       {2, robot.joints[2].IA, 0.1, spring(4e-3)}});
  }
  [[nodiscard]] double energy(const VectorXd& q, const VectorXd& dq) const {
    double sum = test::energy(links, q({3, 1, 4}), dq({3, 1, 4}));
    sum += robot.joints[0].IA * dq[0] * dq[0] / 2 + robot.joints[2].IA * dq[2] * dq[2] / 2;
    return sum + std::pow(q[0] - q[3], 2) / 2 / 2e-3 + std::pow(q[2] - q[4], 2) / 2 / 4e-3;
  }
  [[nodiscard]] static double lost_power(const VectorXd& dq) {
    const double first = 2 * kGearDamping * std::sqrt(1.5 / 2e-3),
                 second = 2 * kGearDamping * std::sqrt(0.1 / 4e-3);
    return first * std::pow(dq[0] - dq[3], 2) + second * std::pow(dq[2] - dq[4], 2);
  }
  test::NumericRobot robot, links;
  PlantModel plant;
};

TEST(ElasticPlant, GearsTakeAsMuchEnergyAsTheirDamping) {
  const ElasticArm arm;
  Plant plant(arm.plant, {}, arm.plant.at_rest(Eigen::Vector3d(0.5, -1, 2), VectorXd::Zero(3)),
              VectorXd::Zero(5));
  const double before = arm.energy(plant.q(), plant.dq());
  double lost = 0;
  const double h = 2e-4;
  for (int k = 1; k <= 5000; ++k) {
    const double left = ElasticArm::lost_power(plant.dq());
    plant.advance(none(), k * h);
    lost += h * (left + ElasticArm::lost_power(plant.dq())) / 2;
  }
  EXPECT_GT(lost, 1e-3);
  EXPECT_NEAR(arm.energy(plant.q(), plant.dq()), before - lost, 1e-3 * lost + 1e-7);
}

TEST(ElasticPlant, ForwardAndRigidAndMassMatrixAreOneModel) {
  const ElasticArm arm;
  VectorXd q(5), dq(5), tau(5), ddq(5), back(5), still(5);
  q << 0.3, -0.4, 0.9, 0.25, 0.95;
  dq << 1, -2, 0.5, 0.8, 0.7;
  tau << 3, 4, -5, 0, 0;
  arm.plant.forward(q.data(), dq.data(), tau.data(), ddq.data());
  arm.plant.rigid(q.data(), dq.data(), ddq.data(), back.data());
  EXPECT_LT((back - tau).cwiseAbs().maxCoeff(), 1e-10);
  MatrixXd M(5, 5);
  arm.plant.mass_matrix(q.data(), M.data());
  const VectorXd zero = VectorXd::Zero(5);
  arm.plant.rigid(q.data(), dq.data(), zero.data(), still.data());
  EXPECT_LT((M * ddq + still - tau).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(ElasticPlant, BeginsWithSpringsThatCarryTheLinks) {
  const ElasticArm arm;
  const VectorXd q = arm.plant.at_rest(Eigen::Vector3d(0.2, 0.1, -0.3), VectorXd::Zero(3));
  EXPECT_GT(std::abs(q[0] - q[3]), 1e-3);
  VectorXd tau(5);
  const VectorXd zero = VectorXd::Zero(5);
  arm.plant.rigid(q.data(), zero.data(), zero.data(), tau.data());
  EXPECT_NEAR(tau[3], 0, 1e-9);
  EXPECT_NEAR(tau[4], 0, 1e-9);
  EXPECT_NEAR(tau[0], (q[0] - q[3]) / 2e-3, 1e-9);
}

ClosedLoopRun run_of(const PlantModel& plant, const test::NumericRobot& robot) {
  ControllerOptions options;
  options.law = ControlLaw::kPd;
  MatrixXd M(3, 3);
  const VectorXd zero = VectorXd::Zero(3);
  test::numeric_plant(robot).mass_matrix(zero.data(), M.data());
  options.gains = torque_gains(M.diagonal(), 3, 1);
  Controller controller(test::numeric_control(robot), options);
  return simulate(plant, controller, test::cosine_trajectory(3, 1, 0.3, 0.5), {});
}

TEST(ElasticPlant, StiffGearsAreARigidRobot) {
  const test::NumericRobot robot = test::planar_arm();
  const ClosedLoopRun rigid = run_of(test::numeric_plant(robot), robot);
  double before = 1;
  for (const double c : {1e-5, 1e-6}) {
    const PlantModel plant = elastic_plant(
        test::numeric_plant(robot),
        {{0, robot.joints[0].IA, 1.5, spring(c)}, {1, robot.joints[1].IA, 0.5, spring(c)}});
    const ClosedLoopRun elastic = run_of(plant, robot);
    ASSERT_EQ(elastic.truth.joints(), 3);
    const double apart = (elastic.truth.q - rigid.truth.q).cwiseAbs().maxCoeff();
    EXPECT_LT(apart, 200 * c);  // N m of load, nearly
    EXPECT_LT(apart, 0.5 * before);
    before = apart;
    // the links are behind by c of their load
    EXPECT_GT((elastic.truth.q - elastic.links.q).col(0).cwiseAbs().maxCoeff(), 10 * c);
    EXPECT_LT((elastic.truth.q - elastic.links.q).cwiseAbs().maxCoeff(), 200 * c);
    EXPECT_EQ(elastic.truth.q.col(2), elastic.links.q.col(2));
  }
}

TEST(ElasticPlant, RefusesWhatDoesNotTurnApart) {
  const test::NumericRobot robot = test::planar_arm();
  const PlantModel rigid = test::numeric_plant(robot);
  const auto refused = [&](std::vector<ElasticJoint> joints) {
    EXPECT_THROW(elastic_plant(rigid, std::move(joints)), std::invalid_argument);
  };
  refused({{3, 0.1, 1, spring(1e-4)}});
  refused({{0, 0, 1, spring(1e-4)}});
  refused({{0, 0.1, 0, spring(1e-4)}});
  refused({{0, 0.1, 1, spring(1e-4)}, {0, 0.1, 1, spring(1e-4)}});
  PlantModel broken = elastic_plant(rigid, {{0, 0.1, 1, spring(1e-4)}});
  broken.at_rest = nullptr;
  EXPECT_THROW(broken.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace dyngen::runtime
