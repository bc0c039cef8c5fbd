// SPDX-License-Identifier: MIT
#include <cmath>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

Truth coulomb_asymmetry(const Machine& machine, Index joint, Random) {
  Truth truth = truth_of("coulomb_asymmetry", joint, "dry friction more by s one way", false);
  truth.typical = 0.2 * machine.coulomb[joint];
  truth.plant = [=](double size, int, Plant& plant) {
    add_strength(plant, joint, [=, c = plant.drive[at(joint)]](const Moment& m) {
      const double way = std::abs(m.v[c]) > 1e-9 ? m.v[c] : m.dry[joint];  // held, it is nearly 0
      return way > 0 ? size : -size;
    });
  };
  return truth;
}

Truth torque_offset(const Machine& machine, Index joint, Random) {
  Truth truth = truth_of("torque_offset", joint, "s more in the record", false);
  truth.typical = 0.3 * machine.coulomb[joint];
  truth.log = [=](double size, int, Log& log) { log.recorded.col(joint).array() += size; };
  return truth;
}

Truth counterbalance(const Machine& machine, Index joint, Random random) {
  Truth truth = truth_of("gravity_spring", joint, "s sin(q + phase)", false);
  const double phase = random.between(0, 2 * kPi);
  truth.typical = machine.coulomb[joint];
  truth.numbers = {{"phase", phase}};
  truth.plant = [=](double size, int, Plant& plant) {
    add_torque(plant, joint, [=, c = plant.carried[at(joint)]](const Moment& m) {
      return -size * std::sin(m.x[c] + phase);
    });
  };
  return truth;
}

Truth payload(const Machine& machine, Index, Random random) {
  Truth truth = truth_of("payload", -1, "the last link carries s kg all the time", false);
  const Index last = machine.joints() - 1;
  Eigen::Vector3d where;
  for (double& each : where) each = random.between(-1, 1) * machine.arm.size[last];
  truth.typical = machine.arm.mass[last];
  truth.tree = [=](double size, Tree& tree) {
    Inertia& own = tree.links[at(link_of(tree, last))].inertia;
    Inertia load;
    load.mass = size;
    load.com = where;
    own = sum({own, load});
  };
  return truth;
}

Truth global_gain(const Machine&, Index, Random) {
  Truth truth = truth_of("torque_gain", -1, "all torques are recorded as (1 + s) of them", false);
  truth.typical = 0.05;
  truth.log = [=](double size, int, Log& log) { log.recorded *= 1 + size; };
  return truth;
}

}  // namespace

std::vector<Physics> hidden_physics() {
  const auto once = [](const Machine&, Index joint) { return joint == 0; };
  // gravity follows the sine of the first joint whose axis is not upright, and of no other
  const auto first_that_lifts = [](const Machine& machine, Index joint) {
    const bool lies = std::abs(machine.tree.gravity.z()) < 1;
    return joint == (lies ? 0 : 1);
  };
  return {{"coulomb_asymmetry", {}, coulomb_asymmetry},
          {"torque_offset", {}, torque_offset},
          {"gravity_spring", first_that_lifts, counterbalance},
          {"payload", once, payload},
          {"torque_gain", once, global_gain}};
}

}  // namespace blind
