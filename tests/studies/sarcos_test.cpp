// SPDX-License-Identifier: MIT
// The Sarcos arm that moves weighs what the identified one weighs, and compensation of that gravity
// is what its step responses need.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <numbers>
#include <random>

#include "runtime/simulation/closed_loop.h"
#include "runtime/tools/dynid/simulate/simulated_robot.h"

namespace dyngen::test {
namespace {

using Eigen::VectorXd;
using runtime::RobotUse;
using runtime::SimulatedRobot;

class Sarcos : public testing::Test {
 protected:
  const SimulatedRobot model_ = runtime::read_simulated_robot(
      DYNGEN_SOURCE_DIR "/robots/sarcos_grla.robot", RobotUse::kController);
  const SimulatedRobot plant_ = runtime::read_simulated_robot(
      DYNGEN_SOURCE_DIR "/tests/studies/robots/sarcos_plant.robot", RobotUse::kPlant);
};

TEST_F(Sarcos, PlantHasTheIdentifiedGravityAndCanMove) {
  std::mt19937_64 random(20261121);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  double least = 1e9;
  for (int k = 0; k < 2000; ++k) {
    const VectorXd q = VectorXd::NullaryExpr(7, [&] { return angle(random); });
    VectorXd identified(7), weighed(7);
    model_.control.gravity(q.data(), identified.data());
    plant_.control.gravity(q.data(), weighed.data());
    EXPECT_LT((identified - weighed).norm(), 1e-9 * identified.norm());
    Eigen::MatrixXd M(7, 7);
    plant_.plant.mass_matrix(q.data(), M.data());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(M, Eigen::EigenvaluesOnly);
    least = std::min(least, spectrum.eigenvalues()[0]);
  }
  EXPECT_GT(least, 0.01);
}

TEST_F(Sarcos, StepsEndAtTheDemandWithCompensationOnly) {
  const VectorXd rest = (VectorXd(7) << 0, 0.5, 0, 0.8, 0, 0, 0).finished();
  Eigen::MatrixXd M(7, 7);
  plant_.plant.mass_matrix(rest.data(), M.data());
  for (int joint = 0; joint < 4; ++joint) {
    VectorXd goal = rest;
    goal[joint] += 0.2;
    runtime::Trajectory step;
    step.time = Eigen::Vector2d(0, 3);
    step.q = goal.transpose().replicate(2, 1);
    step.dq = step.ddq = Eigen::MatrixXd::Zero(2, 7);
    const auto left = [&](runtime::ControlLaw law) {
      runtime::ControllerOptions options;
      options.law = law;
      options.gains = runtime::torque_gains(M.diagonal(), 2, 1);
      runtime::Controller controller(model_.control, options);
      const auto run = runtime::simulate(plant_.plant, controller, step, {},
                                         runtime::StartState{rest, VectorXd::Zero(7)});
      return (goal.transpose() - run.truth.q.bottomRows(1)).cwiseAbs().maxCoeff();
    };
    EXPECT_LT(left(runtime::ControlLaw::kGravity), 0.01) << joint;
    EXPECT_GT(left(runtime::ControlLaw::kPd), 0.03) << joint;
  }
}

}  // namespace
}  // namespace dyngen::test
