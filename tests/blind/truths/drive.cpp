// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

/// Inertia behind the gear of a joint, in the middle of its range.
double carried_inertia(const Plant& plant, const Machine& machine, Index joint) {
  VectorXd q = VectorXd::Zero(plant.links);
  for (Index j = 0; j < machine.joints(); ++j) {
    q[plant.carried[at(j)]] = (machine.arm.q_min[j] + machine.arm.q_max[j]) / 2;
  }
  Dynamics dynamics;
  plant.engine.dynamics(q, VectorXd::Zero(plant.links), dynamics);
  const Index c = plant.carried[at(joint)];
  return dynamics.M(c, c);
}

/// Ties a free motor to its link. torque: of (wind-up, its rate), N m
void tie(Plant& plant, Index link, Index motor, std::function<double(double, double)> torque) {
  plant.forces.push_back([=](const Moment& m, VectorXd& force) {
    const double pull = torque(m.x[link] - m.x[motor], m.v[link] - m.v[motor]);
    force[link] -= pull;
    force[motor] += pull;
  });
}

Truth joint_elasticity(const Machine& machine, Index joint, Random random) {
  Truth truth =
      truth_of("joint_elasticity", joint, "a motor behind a spring of 1/s, with damping", true);
  const double damping = random.between(0.03, 0.1);
  const Machine copy = machine;
  const double heavy = machine.armature[joint];
  truth.typical = 1 / (heavy * std::pow(2 * kPi * 12, 2));
  truth.most = 1 / (heavy * std::pow(2 * kPi * 4, 2));
  truth.numbers = {{"damping_ratio", damping}};
  is_called(truth, "c");
  truth.plant = [=](double size, int, Plant& plant) {
    const double inertia = carried_inertia(plant, copy, joint);
    const Index link = plant.drive[at(joint)], motor = add_motor(plant, joint);
    const double k = 1 / size, d = 2 * damping * std::sqrt(k * inertia);
    tie(plant, link, motor, [=](double wound, double rate) { return k * wound + d * rate; });
  };
  return truth;
}

Truth backlash(const Machine& machine, Index joint, Random) {
  Truth truth =
      truth_of("backlash", joint, "a motor and a link with a gap of s, flanks of 45 Hz", true);
  const Machine copy = machine;
  truth.typical = 2e-3;
  truth.most = 0.05;
  is_called(truth, "gap");
  truth.plant = [=](double size, int, Plant& plant) {
    const double inertia = carried_inertia(plant, copy, joint);
    const double both = inertia * copy.armature[joint] / (inertia + copy.armature[joint]);
    const Index link = plant.drive[at(joint)], motor = add_motor(plant, joint);
    const double k = both * std::pow(2 * kPi * 45, 2), d = 0.6 * std::sqrt(k * both);
    tie(plant, link, motor, [=](double wound, double rate) {
      const double depth = std::abs(wound) - size / 2;
      if (depth <= 0) return 0.0;
      const double side = wound > 0 ? 1 : -1;
      return side * std::max(0.0, k * depth + d * side * rate);  // a flank does not pull
    });
  };
  return truth;
}

Truth torque_ripple(const Machine& machine, Index joint, Random random) {
  const double order = std::round(random.decade(8, 60)), phase = random.between(0, 2 * kPi);
  Truth truth = truth_of("torque_ripple", joint,
                         "s (sin u + 0.4 sin(2 u + 1) + 0.2 sin(3 u)), u = n q + phase", true);
  truth.typical = 0.2 * machine.coulomb[joint];
  truth.numbers = {{"n", order}, {"phase", phase}};
  truth.plant = [=](double size, int, Plant& plant) {
    add_torque(plant, joint, [=, c = plant.drive[at(joint)]](const Moment& m) {
      const double u = order * m.x[c] + phase;
      return -size * (std::sin(u) + 0.4 * std::sin(2 * u + 1) + 0.2 * std::sin(3 * u));
    });
  };
  return truth;
}

/// Torque that a drive asks for at most, about.
double usual_torque(const Machine& machine, Index joint) {
  return machine.coulomb[joint] + machine.viscous[joint] * machine.arm.v_max[joint] +
         machine.armature[joint] * machine.arm.a_max[joint];
}

Truth torque_saturation(const Machine& machine, Index joint, Random) {
  Truth truth = truth_of("torque_saturation", joint,
                         "the motor gives u/sqrt(1 + s (u/u0)^2) of the recorded u", true);
  const double u0 = usual_torque(machine, joint);
  truth.typical = 0.1;
  truth.most = 3;
  truth.numbers = {{"u0", u0}};
  is_called(truth, "c", 1 / (2 * u0 * u0));  // the first term of the series
  truth.plant = [=](double size, int, Plant& plant) {
    change(plant.acting, joint,
           [=](const Moment&, double u) { return u / std::sqrt(1 + size * u * u / (u0 * u0)); });
  };
  return truth;
}

Truth torque_gain(const Machine&, Index joint, Random random) {
  Truth truth = truth_of("torque_gain", joint, "the record is (1 + s) of the torque", false);
  const double sign = random.sign();
  truth.typical = 0.05;
  truth.most = 0.6;
  truth.numbers = {{"sign", sign}};
  is_called(truth, "gain", sign);
  truth.plant = [=](double size, int, Plant& plant) {
    change(plant.recorded, joint, [=](const Moment&, double u) { return (1 + sign * size) * u; });
  };
  return truth;
}

Truth gain_drift(const Machine& machine, Index joint, Random random) {
  Truth truth = truth_of("gain_drift", joint,
                         "the motor gives less by s of what heats it, current squared", true);
  const double warming = random.between(8, 20), u0 = usual_torque(machine, joint);
  truth.typical = 0.05;
  truth.most = 0.8;
  truth.numbers = {{"time_constant", warming}, {"u0", u0}};
  truth.plant = [=](double size, int, Plant& plant) {
    const Index heat = next_state(plant);
    plant.states.push_back(
        {0, [=](const Moment& m) {
           if (m.t < 0) return 0.0;  // cold until the recording begins
           return (4 * m.command[joint] * m.command[joint] / (u0 * u0) - m.z[heat]) / warming;
         }});
    change(plant.acting, joint,
           [=](const Moment& m, double u) { return u / (1 + size * m.z[heat]); });
  };
  return truth;
}

Truth actuator_lag(const Machine&, Index joint, Random) {
  Truth truth = truth_of("actuator_lag", joint,
                         "the motor follows the recorded torque through two "
                         "lags of s/2",
                         true);
  truth.typical = 0.003;
  truth.most = 0.03;
  is_called(truth, "T");
  truth.plant = [=](double size, int, Plant& plant) {
    const Index first = next_state(plant), second = first + 1;
    plant.states.push_back(
        {0, [=](const Moment& m) { return (m.command[joint] - m.z[first]) * 2 / size; }});
    plant.states.push_back(
        {0, [=](const Moment& m) { return (m.z[first] - m.z[second]) * 2 / size; }});
    change(plant.acting, joint, [=](const Moment& m, double) { return m.z[second]; });
  };
  return truth;
}

}  // namespace

std::vector<Physics> drive_physics(const Schedule&) {
  return {{"joint_elasticity", {}, joint_elasticity}, {"backlash", {}, backlash},
          {"torque_ripple", {}, torque_ripple},       {"torque_saturation", {}, torque_saturation},
          {"torque_gain", {}, torque_gain},           {"gain_drift", {}, gain_drift},
          {"actuator_lag", {}, actuator_lag}};
}

}  // namespace blind
