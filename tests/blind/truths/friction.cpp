// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

Truth stribeck(const Machine& machine, Index joint, Random random) {
  const bool rational = random.chance(0.6);
  Truth truth = truth_of(
      "stribeck", joint,
      rational ? "s/(1 + (v/vs)^2) more dry friction" : "s exp(-|v/vs|^0.6) more dry friction",
      true);
  const double vs = random.decade(0.02, 0.08) * machine.arm.v_max[joint];
  truth.typical = 0.3 * machine.coulomb[joint];
  truth.numbers = {{"vs", vs}};
  truth.plant = [=](double size, int, Plant& plant) {
    add_strength(plant, joint, [=, c = plant.drive[at(joint)]](const Moment& m) {
      const double u = std::abs(m.v[c] / vs);
      return rational ? size / (1 + u * u) : size * std::exp(-std::pow(u, 0.6));
    });
  };
  return truth;
}

Truth nonlinear_viscous(const Machine& machine, Index joint, Random random) {
  Truth truth = truth_of("nonlinear_viscous", joint, "s v/sqrt(1 + (v/v0)^2)", true);
  const double v0 = random.between(0.1, 0.35) * machine.arm.v_max[joint];
  truth.typical = 0.5 * machine.viscous[joint];
  truth.numbers = {{"v0", v0}};
  truth.plant = [=](double size, int, Plant& plant) {
    add_torque(plant, joint, [=, c = plant.drive[at(joint)]](const Moment& m) {
      return -size * m.v[c] / std::hypot(1, m.v[c] / v0);
    });
  };
  return truth;
}

Truth asymmetric_viscous(const Machine& machine, Index joint, Random random) {
  Truth truth = truth_of("asymmetric_viscous", joint, "s |v|", false);
  const double sign = random.sign();
  truth.typical = 0.1 * machine.viscous[joint];
  truth.numbers = {{"sign", sign}};
  is_called(truth, "dFv", sign);
  truth.plant = [=](double size, int, Plant& plant) {
    add_torque(plant, joint, [=, c = plant.drive[at(joint)]](const Moment& m) {
      return -sign * size * std::abs(m.v[c]);
    });
  };
  return truth;
}

Truth quadratic_drag(const Machine& machine, Index joint, Random) {
  Truth truth = truth_of("quadratic_drag", joint, "s v |v|", false);
  truth.typical = 0.2 * machine.viscous[joint];
  is_called(truth, "b");
  truth.plant = [=](double size, int, Plant& plant) {
    add_torque(plant, joint, [=, c = plant.drive[at(joint)]](const Moment& m) {
      return -size * m.v[c] * std::abs(m.v[c]);
    });
  };
  return truth;
}

Truth load_friction(const Machine& machine, Index joint, Random random) {
  const bool smooth = random.chance(0.5);
  Truth truth = truth_of(
      "load_friction", joint,
      smooth ? "s sqrt(load^2 + l0^2) more dry friction" : "s |load| more dry friction", smooth);
  const double l0 = smooth ? 0.3 * machine.coulomb[joint] : 0;
  truth.typical = 0.05;
  truth.most = 0.8;
  truth.numbers = {{"l0", l0}};
  is_called(truth, "mu");
  truth.plant = [=](double size, int, Plant& plant) {
    add_strength(plant, joint,
                 [=](const Moment& m) { return size * std::hypot(m.load[joint], l0); });
  };
  return truth;
}

Truth position_friction(const Machine& machine, Index joint, Random random) {
  Truth truth =
      truth_of("position_friction", joint, "s exp(2 cos(q - q0) - 2) more dry friction", true);
  const double q0 = random.between(0.7 * machine.arm.q_min[joint], 0.7 * machine.arm.q_max[joint]);
  truth.typical = 0.2 * machine.coulomb[joint];
  truth.numbers = {{"q0", q0}};
  truth.plant = [=](double size, int, Plant& plant) {
    add_strength(plant, joint, [=, c = plant.drive[at(joint)]](const Moment& m) {
      return size * std::exp(2 * std::cos(m.x[c] - q0) - 2);
    });
  };
  return truth;
}

Truth thermal_drift(const Machine& machine, Index joint, Random random) {
  Truth truth = truth_of("thermal_drift", joint,
                         "friction less by s of it, as the joint warms by its own friction", true);
  const double warming = random.between(6, 15);
  const double coulomb = machine.coulomb[joint], viscous = machine.viscous[joint];
  const double power = 0.3 * machine.arm.v_max[joint] * coulomb;
  truth.typical = 0.4;
  truth.most = 0.9;
  truth.numbers = {{"time_constant", warming}};
  truth.plant = [=](double size, int, Plant& plant) {
    const Index c = plant.drive[at(joint)];
    const Index heat = next_state(plant);
    plant.states.push_back({0, [=](const Moment& m) {
                              if (m.t < 0) return 0.0;  // cold until the recording begins
                              const double lost =
                                  std::abs(m.dry[joint] * m.v[c]) + viscous * m.v[c] * m.v[c];
                              return (lost / power - m.z[heat]) / warming;
                            }});
    const auto less = [=](const Moment& m) { return size * (1 - std::exp(-m.z[heat])); };
    add_strength(plant, joint, [=](const Moment& m) { return -coulomb * less(m); });
    add_torque(plant, joint, [=](const Moment& m) { return viscous * less(m) * m.v[c]; });
  };
  return truth;
}

Truth joint_coupling(const Machine& machine, Index joint, Random) {
  Truth truth = truth_of("joint_coupling", joint,
                         "a motor that the next joint turns too: s sign(v + v_next)", false);
  truth.other = truth.joint + 1;
  truth.typical = 0.5 * std::min(machine.coulomb[joint], machine.coulomb[joint + 1]);
  truth.parameters = [](double size) {
    return std::map<std::string, double>{{"F", size}, {"ratio", 1}};
  };
  truth.formula = "F*both where torque_other = ratio*F*both, both = sign(qd + ratio*qd_other)";
  truth.plant = [=](double size, int, Plant& plant) {
    VectorXd along = VectorXd::Zero(plant.coordinates());
    along[plant.drive[at(joint)]] = along[plant.drive[at(joint + 1)]] = 1;
    plant.friction.push_back({along, [size](const Moment&) { return size; }});
  };
  return truth;
}

/// Springs that slip one after the other (Iwan's distribution, of six): 0.15 to 2 times the size.
Truth presliding(const Machine& machine, Index joint, Random) {
  Truth truth = truth_of("presliding", joint,
                         "all dry friction by six springs that slip at 0.15 to 2 s", true);
  truth.typical = 2e-3;
  truth.least = 1e-4;
  truth.most = 0.05;
  const double coulomb = machine.coulomb[joint];
  truth.plant = [=](double size, int, Plant& plant) {
    constexpr std::array<double, 6> kReach = {0.15, 0.3, 0.6, 1, 1.5, 2};
    const Index c = plant.drive[at(joint)];
    std::vector<Index> springs;
    for (const double reach : kReach) {
      const Index place = next_state(plant);
      springs.push_back(place);
      plant.states.push_back({0, [=](const Moment& m) {
                                const double u = m.z[place] / (reach * size);
                                const bool loads = u * m.v[c] > 0;
                                return m.v[c] *
                                       (loads ? 1 - std::min(1.0, std::pow(std::abs(u), 12.0)) : 1);
                              }});
    }
    plant.friction[at(joint)].strength = [](const Moment&) { return 0.0; };
    add_torque(plant, joint, [=](const Moment& m) {
      double part = 0;
      for (std::size_t i = 0; i < springs.size(); ++i) part += m.z[springs[i]] / (kReach[i] * size);
      return -coulomb * part / static_cast<double>(springs.size());
    });
  };
  return truth;
}

}  // namespace

std::vector<Physics> friction_physics(const Schedule&) {
  const auto not_last = [](const Machine& machine, Index joint) {
    return joint + 1 < machine.joints();
  };
  return {{"stribeck", {}, stribeck},
          {"nonlinear_viscous", {}, nonlinear_viscous},
          {"asymmetric_viscous", {}, asymmetric_viscous},
          {"quadratic_drag", {}, quadratic_drag},
          {"load_friction", {}, load_friction},
          {"position_friction", {}, position_friction},
          {"thermal_drift", {}, thermal_drift},
          {"joint_coupling", not_last, joint_coupling},
          {"presliding", {}, presliding}};
}

}  // namespace blind
