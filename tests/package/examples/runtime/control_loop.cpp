// SPDX-License-Identifier: MIT
// A computed-torque controller of a generated model, behind an encoder.
#include <cmath>

#include "../pendulum.h"
#include "runtime/control/control_model.h"
#include "runtime/control/controller.h"
#include "runtime/control/gains.h"
#include "runtime/control/velocity_filter.h"
#include "runtime/model/model_functions.h"

using namespace dyngen::runtime;

int main() {
  // before the loop: may allocate, and throws if something does not fit
  const ModelFunctions functions{
      "pendulum",        1, {"joint1"}, pendulum::id, pendulum::gravity, pendulum::coriolis,
      pendulum::friction};
  functions.validate();
  const ControlModel model = control_model(functions);
  ControllerOptions options;
  options.law = ControlLaw::kComputedTorque;
  options.gains = acceleration_gains(1, 3, 1);  // Hz, damping ratio
  options.friction = true;
  Controller controller(model, options);
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(1);
  VelocityFilter velocity({.sample_time = 1e-3, .cutoff_hz = 60}, start, start);

  // in the loop: allocates nothing
  const double q = 0, reference = 0.1, rest = 0;
  const double dq = velocity.update(&q)[0];
  double tau = 0;
  controller.step({&q, &dq, &reference, &rest, &rest}, &tau);
  return tau > 0 && std::isfinite(tau) && dq == 0 ? 0 : 1;
}
