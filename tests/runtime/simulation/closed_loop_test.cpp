// SPDX-License-Identifier: MIT
#include "runtime/simulation/closed_loop.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/runtime/simulation/simulated_arms.h"
#include "tests/support/numeric_plant.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Controller computed_torque(const test::NumericRobot& model, bool friction,
                           FrictionVelocity velocity = FrictionVelocity::kReference) {
  ControllerOptions options;
  options.law = ControlLaw::kComputedTorque;
  options.gains = acceleration_gains(static_cast<int>(model.size()), 3, 1);
  options.friction = friction;
  options.friction_velocity = velocity;
  return {test::numeric_control(model), options};
}

/// No Coulomb friction: what remains is linear in velocity and compensated exactly.
test::NumericRobot smooth_arm() {
  test::NumericRobot robot = test::planar_arm();
  for (test::NumericJoint& joint : robot.joints) joint.Fs = 0;
  return robot;
}

double worst(const ClosedLoopRun& run) { return tracking_of(run).worst.maxCoeff(); }

TEST(ClosedLoop, ContinuousComputedTorqueTracksToIntegrationAccuracy) {
  const test::NumericRobot robot = smooth_arm();
  Controller controller = computed_torque(robot, true);
  ClosedLoopOptions options;
  options.continuous = true;
  const Trajectory trajectory = test::cosine_trajectory(3, 3, 0.5, 0.5);
  const ClosedLoopRun run = simulate(test::numeric_plant(robot), controller, trajectory, options);
  EXPECT_LT(worst(run), 1e-8);
  options.continuous = false;
  const ClosedLoopRun sampled =
      simulate(test::numeric_plant(robot), controller, trajectory, options);
  EXPECT_GT(worst(sampled), 1e-5);  // what sample and hold leaves
  EXPECT_LT(worst(sampled), 1e-3);
}

TEST(ClosedLoop, AStartAsideDecaysAsTheGainsSay) {
  // e'' + 2 w e' + w^2 e = 0 from e0 at rest: e = e0 (1 + w t) exp(-w t)
  const test::NumericRobot robot = smooth_arm();
  Controller controller = computed_torque(robot, true, FrictionVelocity::kMeasured);
  ClosedLoopOptions options;
  options.continuous = true;
  const Eigen::Vector3d goal(0.3, -0.2, 0.4);
  const ClosedLoopRun run =
      simulate(test::numeric_plant(robot), controller, test::constant_trajectory(goal, 1), options,
               StartState{VectorXd::Zero(3), VectorXd::Zero(3)});
  const double w = 6 * std::numbers::pi;
  for (Index k = 0; k < run.truth.samples(); k += 50) {
    const double t = run.truth.time[k];
    const double left = (1 + w * t) * std::exp(-w * t);
    EXPECT_TRUE((run.truth.q.row(k).transpose() - (1 - left) * goal).isZero(1e-7)) << t;
  }
}

TEST(ClosedLoop, SampleAndHoldIsOfTheFirstOrder) {
  const test::NumericRobot robot = smooth_arm();
  Controller controller = computed_torque(robot, true);
  const Trajectory trajectory = test::cosine_trajectory(3, 2, 0.5, 0.5);
  ClosedLoopOptions options;
  options.rate = 500;
  const double slow = worst(simulate(test::numeric_plant(robot), controller, trajectory, options));
  options.rate = 2000;
  const double fast = worst(simulate(test::numeric_plant(robot), controller, trajectory, options));
  EXPECT_NEAR(slow / fast, 4, 0.4);
}

TEST(ClosedLoop, TruthObeysTheEquationsOfMotion) {
  const test::NumericRobot robot = test::planar_arm();
  Controller controller = computed_torque(robot, true);
  const ClosedLoopRun run =
      simulate(test::numeric_plant(robot), controller, test::cosine_trajectory(3, 1, 0.5, 0.5), {});
  const ControlModel model = test::numeric_control(robot);
  // ddq is that right after the sample, tau the mean of what is held before and after: they differ
  // by half of the torque's step
  for (Index k = 1; k < run.truth.samples(); k += 10) {
    const VectorXd q = run.truth.q.row(k), dq = run.truth.dq.row(k), ddq = run.truth.ddq.row(k);
    if ((dq.array().abs() < 1e-3).any()) continue;
    VectorXd rigid(3), friction(3);
    model.rigid(q.data(), dq.data(), ddq.data(), rigid.data());
    model.friction(dq.data(), friction.data());
    const VectorXd step = run.truth.tau.row(k) - run.truth.tau.row(k - 1);
    EXPECT_TRUE((rigid + friction - run.truth.tau.row(k).transpose()).isZero(step.norm() + 0.2))
        << k;
  }
}

TEST(ClosedLoop, SensorsSeeWhatTheyShould) {
  const test::NumericRobot robot = test::planar_arm();
  Controller controller = computed_torque(robot, true);
  ClosedLoopOptions options;
  options.encoder_step = VectorXd::Constant(3, 1e-3);
  options.velocity_cutoff_hz = 40;
  options.torque_noise.deviation = Eigen::Vector3d(1, 0.5, 0);
  options.seed = 5;
  const Trajectory trajectory = test::cosine_trajectory(3, 2, 0.5, 0.5);
  const ClosedLoopRun run = simulate(test::numeric_plant(robot), controller, trajectory, options);
  const Eigen::ArrayXXd error = (run.measured.q - run.truth.q).array();
  EXPECT_LE(error.abs().maxCoeff(), 0.5e-3 + 1e-12);
  EXPECT_GT(error.abs().maxCoeff(), 0.4e-3);
  const Eigen::MatrixXd noise = run.measured.tau - run.truth.tau;
  const double samples = static_cast<double>(noise.rows());
  EXPECT_NEAR(std::sqrt(noise.col(0).squaredNorm() / samples), 1, 0.15);
  EXPECT_TRUE(noise.col(2).isZero(0));
  EXPECT_LT((run.measured.dq - run.truth.dq).cwiseAbs().mean(), 0.2);
  const ClosedLoopRun again = simulate(test::numeric_plant(robot), controller, trajectory, options);
  EXPECT_EQ(again.measured.tau, run.measured.tau);
  EXPECT_EQ(again.truth.q, run.truth.q);
  options.seed = 6;
  EXPECT_NE(simulate(test::numeric_plant(robot), controller, trajectory, options).measured.tau,
            run.measured.tau);
}

TEST(ClosedLoop, EncodersHaveNoiseThatTheControllerSees) {
  const test::NumericRobot robot = test::planar_arm();
  Controller controller = computed_torque(robot, true);
  ClosedLoopOptions options;
  options.encoder_step = VectorXd::Constant(3, 1e-3);
  options.encoder_noise = 2;
  const Trajectory trajectory = test::cosine_trajectory(3, 2, 0.5, 0.5);
  const ClosedLoopRun run = simulate(test::numeric_plant(robot), controller, trajectory, options);
  const Eigen::MatrixXd error = run.measured.q - run.truth.q;
  // rounding adds a twelfth of a step's square
  const double expected = 1e-3 * std::sqrt(4 + 1.0 / 12);
  EXPECT_NEAR(std::sqrt(error.squaredNorm() / static_cast<double>(error.size())), expected,
              0.04 * expected);
  EXPECT_LT((run.measured.q / 1e-3 - (run.measured.q / 1e-3).array().round().matrix()).norm(),
            1e-6);
  options.seed = 7;
  EXPECT_NE(simulate(test::numeric_plant(robot), controller, trajectory, options).truth.q,
            run.truth.q);
}

TEST(ClosedLoop, DelayShiftsTheTorque) {
  // The drive's force is seen in the acceleration of a mass without friction.
  test::NumericRobot mass = test::slide();
  mass.joints[0].Fs = 0;
  ControllerOptions chosen;
  chosen.law = ControlLaw::kPd;
  chosen.gains = torque_gains(VectorXd::Constant(1, 2), 0.5, 1);
  Controller controller(test::numeric_control(mass), chosen);
  ClosedLoopOptions options;
  options.rate = 100;
  const VectorXd goal = VectorXd::Ones(1);
  const StartState start{VectorXd::Zero(1), VectorXd::Zero(1)};
  for (const double delay : {0.0, 0.01, 0.03, 0.025}) {
    options.delay = delay;
    const ClosedLoopRun run = simulate(test::numeric_plant(mass), controller,
                                       test::constant_trajectory(goal, 1), options, start);
    const Index late = static_cast<Index>(std::ceil(delay * 100 - 1e-9));
    for (Index k = late; k < 20; ++k) {
      const double asked = chosen.gains.kp[0] * (1 - run.truth.q(k - late, 0)) -
                           chosen.gains.kd[0] * run.truth.dq(k - late, 0);
      EXPECT_NEAR(run.truth.ddq(k, 0), asked / 2, 1e-9) << delay << " " << k;
    }
  }
}

TEST(ClosedLoop, ALagLetsTheJointHaveItsTorqueLater) {
  test::NumericRobot mass = test::slide();
  mass.joints[0].Fs = 0;
  ControllerOptions chosen;
  chosen.law = ControlLaw::kPd;
  chosen.gains = torque_gains(VectorXd::Constant(1, 2), 0.5, 1);
  chosen.torque_limit = VectorXd::Constant(1, 12);
  Controller controller(test::numeric_control(mass), chosen);
  ClosedLoopOptions options;
  options.rate = 100;
  PlantModel plant = test::numeric_plant(mass);
  plant.lag = VectorXd::Constant(1, 0.05);
  const StartState start{VectorXd::Zero(1), VectorXd::Zero(1)};
  for (const double delay : {0.0, 0.013}) {
    options.delay = delay;
    const ClosedLoopRun run = simulate(
        plant, controller, test::constant_trajectory(VectorXd::Ones(1), 1), options, start);
    // dF/dt = (command - F) / lag with the command held: F from one sample to the next
    const auto asked = [&](Index k) {
      k = std::max<Index>(k, 0);
      const double force =
          chosen.gains.kp[0] * (1 - run.truth.q(k, 0)) - chosen.gains.kd[0] * run.truth.dq(k, 0);
      return std::clamp(force, -12.0, 12.0);
    };
    const Index whole = static_cast<Index>(delay * 100);
    const double late = delay - 0.01 * static_cast<double>(whole);
    double force = asked(0);
    for (Index k = 0; k + 1 < run.truth.samples(); ++k) {
      EXPECT_NEAR(run.truth.ddq(k, 0), force / 2, 1e-8) << delay << " " << k;
      const double before = asked(k - whole - 1), after = asked(k - whole);
      if (late > 0) force = before + (force - before) * std::exp(-late / 0.05);
      force = after + (force - after) * std::exp(-(0.01 - late) / 0.05);
    }
    EXPECT_LE(run.measured.tau.cwiseAbs().maxCoeff(), 12);
  }
  options = {.continuous = true};
  EXPECT_THROW(
      simulate(plant, controller, test::constant_trajectory(VectorXd::Ones(1), 1), options, start),
      std::invalid_argument);
}

TEST(ClosedLoop, CountsWhatIsSaturatedAndStuck) {
  const test::NumericRobot robot = test::slide();
  ControllerOptions chosen;
  chosen.law = ControlLaw::kPd;
  chosen.gains = torque_gains(VectorXd::Constant(1, 2), 2, 0.3);
  chosen.torque_limit = VectorXd::Constant(1, 10);
  Controller controller(test::numeric_control(robot), chosen);
  const StartState start{VectorXd::Zero(1), VectorXd::Zero(1)};
  const Trajectory step = test::constant_trajectory(VectorXd::Ones(1), 4);
  const ClosedLoopRun run = simulate(test::numeric_plant(robot), controller, step, {}, start);
  EXPECT_EQ(run.largest_torque[0], 10);
  EXPECT_GT(run.saturated_share[0], 0.02);
  EXPECT_LT(run.saturated_share[0], 0.5);
  EXPECT_GT(run.stuck_share[0], 0.3);  // short of the goal, where kp e is less than Fs
  const Index last = run.truth.samples() - 1;
  EXPECT_EQ(run.truth.dq(last, 0), 0);
  const double error = 1 - run.truth.q(last, 0);
  EXPECT_GT(std::abs(error), 1e-3);
  EXPECT_LE(chosen.gains.kp[0] * std::abs(error), 3.0000001);
}

TEST(ClosedLoop, RefusesWhatDoesNotFit) {
  const test::NumericRobot robot = test::planar_arm();
  Controller controller = computed_torque(robot, false);
  const PlantModel plant = test::numeric_plant(robot);
  const Trajectory trajectory = test::cosine_trajectory(3, 1, 0.5, 0.5);
  const auto refused = [&](ClosedLoopOptions options) {
    EXPECT_THROW(simulate(plant, controller, trajectory, options), std::invalid_argument);
  };
  refused({.rate = 0});
  refused({.continuous = true, .delay = 0.1});
  refused({.continuous = true, .velocity_cutoff_hz = 10});
  refused({.delay = -1});
  refused({.encoder_step = VectorXd::Ones(2)});
  refused({.encoder_noise = -1});
  EXPECT_THROW(simulate(plant, controller, test::cosine_trajectory(2, 1, 0.5, 0.5), {}),
               std::invalid_argument);
  EXPECT_THROW(simulate(test::numeric_plant(test::slide()), controller, trajectory, {}),
               std::invalid_argument);
}

TEST(ClosedLoop, SaysThatAnUnstableLoopDoesNotStayBounded) {
  const test::NumericRobot robot = smooth_arm();
  ControllerOptions chosen;
  chosen.law = ControlLaw::kComputedTorque;
  chosen.gains = acceleration_gains(3, 400, 1);  // sampled at 100 Hz
  Controller controller(test::numeric_control(robot), chosen);
  EXPECT_THROW(simulate(test::numeric_plant(robot), controller,
                        test::cosine_trajectory(3, 5, 0.5, 0.5), {.rate = 100}),
               std::runtime_error);
}

}  // namespace
}  // namespace dyngen::runtime
