// SPDX-License-Identifier: MIT
// The pendulum under control: dry friction, an encoder, and what is recorded of it.
#include "runtime/simulation/closed_loop.h"

#include <cstdio>

#include "../pendulum.h"
#include "runtime/control/control_model.h"
#include "runtime/control/controller.h"
#include "runtime/control/gains.h"
#include "runtime/recordings/trajectory_file.h"
#include "runtime/simulation/plant.h"
#include "runtime/simulation/plant_model.h"

using namespace dyngen::runtime;

namespace {

constexpr double kCoulomb = 0.5;

double sign(double x) { return static_cast<double>(x > 0) - static_cast<double>(x < 0); }

PlantModel plant_model() {
  PlantModel plant;
  plant.joints = 1;
  plant.rigid = pendulum::rigid;
  plant.mass_matrix = [](const double*, double* M) { M[0] = pendulum::kInertia; };
  plant.friction = [](const double* dq, double* tau) {
    tau[0] = kCoulomb * sign(dq[0]) + pendulum::kViscous * dq[0];
  };
  plant.forward = [](const double* q, const double* dq, const double* tau, double* ddq) {
    double weight = 0;
    pendulum::gravity(q, &weight);
    ddq[0] = (tau[0] - weight - kCoulomb * sign(dq[0]) - pendulum::kViscous * dq[0]) /
             pendulum::kInertia;
  };
  plant.coulomb = Eigen::VectorXd::Constant(1, kCoulomb);
  return plant;
}

}  // namespace

int main() {
  // alone: it swings until friction holds it
  Plant plant(plant_model(), {}, Eigen::VectorXd::Constant(1, 0.5), Eigen::VectorXd::Zero(1));
  plant.advance([](double, const double*, const double*, double* tau) { tau[0] = 0; }, 20);
  if (plant.stuck_time()[0] <= 0) return 2;

  // under control, along a trajectory
  Trajectory trajectory;
  constexpr int kSamples = 1001;
  trajectory.time.resize(kSamples);
  trajectory.q.resize(kSamples, 1);
  trajectory.dq.resize(kSamples, 1);
  trajectory.ddq.resize(kSamples, 1);
  for (int k = 0; k < kSamples; ++k) {
    trajectory.time[k] = 0.005 * k;
    const pendulum::State state = pendulum::motion_at(trajectory.time[k]);
    trajectory.q(k, 0) = state.q;
    trajectory.dq(k, 0) = state.dq;
    trajectory.ddq(k, 0) = state.ddq;
  }
  ControlModel model;
  model.joints = 1;
  model.rigid = pendulum::rigid;
  model.gravity = pendulum::gravity;
  ControllerOptions options;
  options.gains = acceleration_gains(1, 5, 1);
  Controller controller(model, options);
  ClosedLoopOptions loop;
  loop.encoder_step = Eigen::VectorXd::Constant(1, 1e-5);
  const ClosedLoopRun run = simulate(plant_model(), controller, trajectory, loop);
  const Tracking tracking = tracking_of(run);
  std::printf("rms tracking error: %.2f mrad\n", 1e3 * tracking.rms[0]);
  return run.measured.samples() > 0 && tracking.rms[0] < 0.05 ? 0 : 1;
}
