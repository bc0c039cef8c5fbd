// SPDX-License-Identifier: MIT
// A motion whose recording says most about the parameters, within limits.
#include <cstdio>

#include "../pendulum_model.h"
#include "runtime/excitation/excitation.h"
#include "runtime/excitation/motion_limits.h"
#include "runtime/excitation/multistage.h"

using namespace dyngen::runtime;

int main() {
  const LinearModel model = pendulum_model();
  MotionLimits limits;
  limits.lower = Eigen::VectorXd::Constant(1, -2);
  limits.upper = Eigen::VectorXd::Constant(1, 2);
  limits.speed = Eigen::VectorXd::Constant(1, 3);
  limits.acceleration = Eigen::VectorXd::Constant(1, 10);
  limits.torque = Eigen::VectorXd::Constant(1, 20);
  limits.beta = Eigen::Vector3d(pendulum::kInertia, pendulum::kMoment, pendulum::kViscous);
  limits.validate(model);

  ExcitationOptions options;
  options.starts = 1;
  options.evaluations = 50;
  options.check_rate = 1000;
  const Excitation found = excite(model, limits, options);
  if (!found.found) return 2;
  std::printf("condition number: %.1f, of a random motion %.1f\n", found.starts[0].optimised,
              found.starts[0].random);

  // the algorithm of several stages, from accelerations that are held for 5 ms each
  MultistageOptions stages;
  stages.iterations = 1;
  HeldAccelerations start;
  start.start = Eigen::VectorXd::Zero(1);
  start.u.resize(400, 1);
  for (Eigen::Index k = 0; k < start.u.rows(); ++k) start.u(k, 0) = (k / 50) % 2 == 0 ? 2.0 : -2.0;
  const MultistageResult better = multistage(model, limits, start, stages);
  return found.shares.largest() <= 1 && better.trajectory.u.rows() == 400 ? 0 : 1;
}
