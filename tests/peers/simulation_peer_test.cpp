// SPDX-License-Identifier: MIT
// Closed loops against MuJoCo: the same torque law, another library's dynamics and integrator.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include "runtime/simulation/closed_loop.h"
#include "tests/peers/mujoco_model.h"
#include "tests/support/model_bridge.h"
#include "tests/support/numeric_plant.h"

namespace dyngen::test {
namespace {

using Eigen::Index;
using Eigen::Map;
using Eigen::VectorXd;

runtime::Trajectory cosines(Index joints, double seconds) {
  const double step = 0.005;
  const Index samples = 1 + std::lround(seconds / step);
  runtime::Trajectory trajectory;
  trajectory.time.resize(samples);
  for (auto* part : {&trajectory.q, &trajectory.dq, &trajectory.ddq}) {
    part->resize(samples, joints);
  }
  for (Index k = 0; k < samples; ++k) {
    const double t = trajectory.time[k] = static_cast<double>(k) * step;
    for (Index j = 0; j < joints; ++j) {
      const double w = 2 * std::numbers::pi * 0.4 * (1 + 0.2 * static_cast<double>(j));
      trajectory.q(k, j) = 0.6 * (1 - std::cos(w * t));
      trajectory.dq(k, j) = 0.6 * w * std::sin(w * t);
      trajectory.ddq(k, j) = 0.6 * w * w * std::cos(w * t);
    }
  }
  return trajectory;
}

/// Positions at the samples of a controller that acts every `period`, over steps of period / 20.
Eigen::MatrixXd mujoco_run(const NumericRobot& robot, runtime::Controller& controller,
                           const runtime::Trajectory& trajectory, double period, Index samples) {
  const std::unique_ptr<mjModel, void (*)(mjModel*)> model(make_mujoco_model(robot),
                                                           mj_deleteModel);
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(model.get()), mj_deleteData);
  constexpr int kSteps = 20;
  model->opt.integrator = mjINT_RK4;
  model->opt.timestep = period / kSteps;
  mj_setConst(model.get(), data.get());
  mj_resetData(model.get(), data.get());
  const Index n = controller.joints();
  Map<VectorXd>(data->qpos, n) = trajectory.q.row(0);
  Map<VectorXd>(data->qvel, n) = trajectory.dq.row(0);
  Eigen::MatrixXd positions(samples, n);
  VectorXd q(n), dq(n), ddq(n);
  for (Index k = 0; k < samples; ++k) {
    positions.row(k) = Map<VectorXd>(data->qpos, n);
    runtime::motion_at(trajectory, static_cast<double>(k) * period, q.data(), dq.data(),
                       ddq.data());
    controller.step({data->qpos, data->qvel, q.data(), dq.data(), ddq.data()}, data->qfrc_applied);
    for (int step = 0; step < kSteps; ++step) mj_step(model.get(), data.get());
  }
  return positions;
}

TEST(SimulationPeer, ClosedLoopsAgreeWithMuJoCo) {
  for (const char* file :
       {"robots/planar2r.robot", "robots/puma560.robot", "tests/studies/robots/panda.robot"}) {
    const NumericRobot robot = without_friction(numeric_robot(read_model(file)));
    const runtime::PlantModel plant = numeric_plant(robot);
    const Index n = plant.joints;
    const runtime::Trajectory trajectory = cosines(n, 5);
    for (const runtime::ControlLaw law :
         {runtime::ControlLaw::kGravity, runtime::ControlLaw::kComputedTorque}) {
      Eigen::MatrixXd M(n, n);
      const VectorXd posture = trajectory.q.row(0);
      plant.mass_matrix(posture.data(), M.data());
      runtime::ControllerOptions options;
      options.law = law;
      options.gains = law == runtime::ControlLaw::kComputedTorque
                          ? runtime::acceleration_gains(plant.joints, 2, 0.7)
                          : runtime::torque_gains(M.diagonal(), 2, 0.7);
      runtime::Controller controller(numeric_control(robot), options);
      const runtime::ClosedLoopRun run = runtime::simulate(plant, controller, trajectory, {});
      const Eigen::MatrixXd peer =
          mujoco_run(robot, controller, trajectory, 1e-3, run.truth.samples());
      const double difference = (run.truth.q - peer).cwiseAbs().maxCoeff();
      std::printf("%s %s: largest difference %.2g rad, tracking error %.2g rad\n", file,
                  runtime::law_name(law).c_str(), difference,
                  runtime::tracking_of(run).worst.maxCoeff());
      EXPECT_LT(difference, 1e-10) << file;
    }
  }
}

}  // namespace
}  // namespace dyngen::test
