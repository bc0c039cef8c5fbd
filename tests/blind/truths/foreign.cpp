// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

/// Liquid in a container at the tool: a pendulum that the last link carries.
Truth sloshing(const Machine& machine, Random random) {
  Truth truth = truth_of("unknown", -1, "a pendulum of s kg on the last link", true);
  const Index last = machine.joints() - 1;
  const double length = random.between(0.06, 0.2), damping = random.between(0.03, 0.1);
  truth.typical = 0.3 * machine.arm.mass[last];
  truth.most = 20;
  truth.numbers = {{"length", length}, {"damping_ratio", damping}};
  truth.tree = [=](double size, Tree& tree) {
    Link bob;
    bob.name = "bob";
    bob.axis = Eigen::Vector3d::UnitX();
    bob.position = Eigen::Vector3d(0, 0, machine.arm.size[last]);
    bob.inertia.mass = size;
    bob.inertia.com = Eigen::Vector3d(0, 0, -length);
    bob.inertia.about_com = 1e-6 * Eigen::Matrix3d::Identity();
    insert_link(tree, link_of(tree, last), bob, false);
  };
  truth.plant = [=](double size, int, Plant& plant) {
    const Index c = plant.carried[at(last)] + 1;
    const double d = 2 * damping * size * length * length * std::sqrt(9.81 / length);
    plant.forces.push_back([=](const Moment& m, VectorXd& force) { force[c] -= d * m.v[c]; });
  };
  return truth;
}

/// A magnet near the path of the tool.
Truth magnet(const Machine& machine, Random random) {
  Truth truth = truth_of("unknown", -1, "a pull of s/(1 + (r/0.25 m)^2) N towards a point", true);
  const Index last = machine.joints() - 1;
  VectorXd q(machine.joints());
  for (Index j = 0; j < q.size(); ++j) {
    const double middle = (machine.arm.q_min[j] + machine.arm.q_max[j]) / 2;
    q[j] = middle + random.between(-0.2, 0.2) * (machine.arm.q_max[j] - machine.arm.q_min[j]);
  }
  const Eigen::Vector3d tool(0, 0, machine.arm.size[last]);
  const Eigen::Vector3d magnet_at =
      mujoco_engine(machine.tree).place(q, static_cast<int>(last), tool);
  truth.typical = 2 * machine.coulomb[last] / machine.arm.size[last];
  truth.plant = [=](double size, int, Plant& plant) {
    const int link = static_cast<int>(plant.carried[at(last)]);
    plant.forces.push_back(
        [=, engine = plant.engine, links = plant.links](const Moment& m, VectorXd& force) {
          const VectorXd x = m.x.head(links);
          const Eigen::Vector3d way = magnet_at - engine.place(x, link, tool);
          const double r = way.norm();
          const Eigen::Vector3d pull = size / (1 + r * r / 0.0625) * way / std::max(r, 0.02);
          force.head(links) += engine.jacobian(x, link, tool).transpose() * pull;
        });
  };
  return truth;
}

/// A hose that rubs where another joint lays it down.
Truth hose(const Machine& machine, Index joint, Random random) {
  Truth truth = truth_of("unknown", joint,
                         "dry friction more by s (1 + sin(2 q_other + phase)), a hose's", true);
  const Index other = joint + 1 < machine.joints() ? joint + 1 : joint - 1;
  const double phase = random.between(0, 2 * kPi);
  truth.other = static_cast<int>(other) + 1;
  truth.typical = 0.3 * machine.coulomb[joint];
  truth.numbers = {{"phase", phase}};
  truth.plant = [=](double size, int, Plant& plant) {
    add_strength(plant, joint, [=, c = plant.drive[at(other)]](const Moment& m) {
      return size * (1 + std::sin(2 * m.x[c] + phase));
    });
  };
  return truth;
}

/// A base on a rail that a spring holds.
Truth rail(const Machine& machine, Random random) {
  Truth truth = truth_of("unknown", -1, "a base of 40 kg on a rail, held by a spring of 1/s", true);
  const double f = random.between(2.5, 5), mass = 40;
  const double all = mass + machine.arm.mass.sum();
  truth.typical = 1 / (all * std::pow(2 * kPi * f, 2));
  truth.most = 1 / (all * std::pow(2 * kPi * 1, 2));
  truth.tree = [=](double, Tree& tree) {
    Link base;
    base.name = "rail";
    base.slides = true;
    base.axis = Eigen::Vector3d::UnitX();
    base.inertia.mass = mass;
    base.inertia.about_com = Eigen::Matrix3d::Identity();
    insert_link(tree, -1, base, true);
  };
  truth.plant = [=](double size, int, Plant& plant) {
    const double k = 1 / size, d = 2 * 0.05 * std::sqrt(k * all);
    plant.forces.push_back(
        [=](const Moment& m, VectorXd& force) { force[0] -= k * m.x[0] + d * m.v[0]; });
  };
  return truth;
}

/// A compensation in the drive that the record does not show, and that reads the wrong encoder and
/// loses its sign.
Truth compensation(const Machine& machine, Index joint, Random) {
  Truth truth = truth_of("unknown", joint,
                         "the drive adds s tanh(|v_other|/0.5 rad/s), which is not recorded", true);
  const Index other = joint + 1 < machine.joints() ? joint + 1 : joint - 1;
  truth.other = static_cast<int>(other) + 1;
  truth.typical = 0.3 * machine.coulomb[joint];
  truth.plant = [=](double size, int, Plant& plant) {
    change(plant.acting, joint, [=, c = plant.drive[at(other)]](const Moment& m, double u) {
      return u + size * std::tanh(std::abs(m.v[c]) / 0.5);
    });
  };
  return truth;
}

}  // namespace

std::vector<Physics> foreign_physics(const Schedule&) {
  const auto once = [](const Machine&, Index joint) { return joint == 0; };
  const auto of_machine = [](Truth (*draw)(const Machine&, Random)) {
    return [draw](const Machine& machine, Index, Random random) { return draw(machine, random); };
  };
  return {{"unknown", once, of_machine(sloshing)},
          {"unknown", once, of_machine(magnet)},
          {"unknown", {}, hose},
          {"unknown", once, of_machine(rail)},
          {"unknown", {}, compensation}};
}

}  // namespace blind
