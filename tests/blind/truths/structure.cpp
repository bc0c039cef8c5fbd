// SPDX-License-Identifier: MIT
#include <cmath>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

Truth link_flexibility(const Machine& machine, Index joint, Random random) {
  Truth truth =
      truth_of("link_flexibility", joint,
               "the outer half of the link on a hinge of its own, with a spring of 1/s", true);
  const double damping = random.between(0.01, 0.04), split = random.between(0.3, 0.6);
  const double heavy = machine.arm.mass.tail(machine.joints() - joint).sum() *
                       std::pow(0.5 * machine.arm.size[joint], 2);
  truth.typical = 1 / (heavy * std::pow(2 * kPi * 9, 2));
  truth.most = 1 / (heavy * std::pow(2 * kPi * 4, 2));
  truth.numbers = {{"damping_ratio", damping}, {"split", split}};
  truth.tree = [=](double, Tree& tree) {
    const int inner = link_of(tree, joint);
    Link& root = tree.links[at(inner)];
    Link tip;
    tip.name = "tip";
    tip.axis = Eigen::Vector3d::UnitZ();
    Eigen::Vector3d along(0, 0, 0);
    for (const Link& link : tree.links) {
      if (link.parent == inner) along = split * link.position;
    }
    tip.position = along;
    tip.inertia = root.inertia;
    tip.inertia.mass /= 2;
    tip.inertia.about_com /= 2;
    tip.inertia.com -= along;
    root.inertia.mass /= 2;
    root.inertia.about_com /= 2;
    const int place = insert_link(tree, inner, tip, true);
    for (Link& link : tree.links) {
      if (link.parent == place) link.position -= along;
    }
  };
  truth.plant = [=](double size, int, Plant& plant) {
    const Index c = plant.carried[at(joint)] + 1;  // the tip stands behind its link
    Dynamics dynamics;
    plant.engine.dynamics(VectorXd::Zero(plant.links), VectorXd::Zero(plant.links), dynamics);
    const double k = 1 / size, d = 2 * damping * std::sqrt(k * dynamics.M(c, c));
    plant.forces.push_back(
        [=](const Moment& m, VectorXd& force) { force[c] -= k * m.x[c] + d * m.v[c]; });
  };
  return truth;
}

Truth gravity_spring(const Machine& machine, Index joint, Random random) {
  Truth truth = truth_of("gravity_spring", joint,
                         "a spring between two points, stiffer as it lengthens: F = s (u + 8 u^3), "
                         "u = l/l0 - 1",
                         true);
  const double a = random.between(0.2, 0.4), b = random.between(0.08, 0.15);
  const double l0 = 0.8 * (a - b);
  const double q0 =
      random.between(0.3, 0.7) * (machine.arm.q_min[joint] + machine.arm.q_max[joint]);
  truth.typical = 0.5 * machine.coulomb[joint] / b;
  truth.numbers = {{"a", a}, {"b", b}, {"l0", l0}, {"q0", q0}};
  truth.plant = [=](double size, int, Plant& plant) {
    add_torque(plant, joint, [=, c = plant.carried[at(joint)]](const Moment& m) {
      const double l = std::sqrt(a * a + b * b - 2 * a * b * std::cos(m.x[c] - q0));
      const double u = l / l0 - 1;
      return -size * (u + 8 * u * u * u) * a * b * std::sin(m.x[c] - q0) / l;
    });
  };
  return truth;
}

Truth cable(const Machine& machine, Index joint, Random random) {
  Truth truth = truth_of("cable", joint, "s (exp(u) - 1 - u), u = side (q - q0)/w", true);
  const double middle = (machine.arm.q_min[joint] + machine.arm.q_max[joint]) / 2;
  const double w =
      random.between(0.15, 0.3) * (machine.arm.q_max[joint] - machine.arm.q_min[joint]);
  const double side = random.sign();
  truth.typical = 0.2 * machine.coulomb[joint];
  truth.numbers = {{"q0", middle}, {"w", w}, {"side", side}};
  truth.plant = [=](double size, int, Plant& plant) {
    add_torque(plant, joint, [=, c = plant.carried[at(joint)]](const Moment& m) {
      const double u = side * (m.x[c] - middle) / w;
      return -side * size * (std::exp(u) - 1 - u);
    });
  };
  return truth;
}

Truth base_tilt(const Machine& machine, Index, Random random) {
  Truth truth = truth_of("base_tilt", -1, "the base is tilted by s", false);
  const double angle = random.between(0, 2 * kPi);
  truth.typical = 0.01;
  truth.most = 0.1;
  truth.numbers = {{"axis", angle}};
  // a tilt that turns gravity: about an axis across it
  const auto tilted = [angle](double size, const Eigen::Vector3d& gravity) -> Eigen::Vector3d {
    const Eigen::Vector3d down = gravity.normalized();
    const Eigen::Vector3d across = down.unitOrthogonal();
    const Eigen::Vector3d axis = std::cos(angle) * across + std::sin(angle) * down.cross(across);
    return Eigen::AngleAxisd(size, axis) * gravity;
  };
  truth.tree = [=](double size, Tree& tree) { tree.gravity = tilted(size, tree.gravity); };
  truth.parameters = [=, level = machine.tree.gravity](double size) {
    const Eigen::Vector3d more = level - tilted(size, level);  // the base's acceleration
    return std::map<std::string, double>{{"gx", more.x()}, {"gy", more.y()}};
  };
  return truth;
}

Truth geometry_error(const Machine&, Index joint, Random random) {
  Truth truth = truth_of("geometry_error", joint, "the link before is longer by s", false);
  const double sign = random.sign();
  truth.typical = 0.02;
  truth.most = 0.3;
  truth.numbers = {{"sign", sign}};
  is_called(truth, "error", sign);
  truth.formula = "error*d_d";
  truth.tree = [=](double size, Tree& tree) {
    Eigen::Vector3d& position = tree.links[at(link_of(tree, joint))].position;
    position.x() += sign * size;
  };
  return truth;
}

}  // namespace

std::vector<Physics> structure_physics(const Schedule&) {
  const auto carries = [](const Machine& machine, Index joint) {
    return joint + 1 < machine.joints() && machine.tree.links[at(joint + 1)].position.norm() > 0.1;
  };
  const auto upright = [](const Machine& machine, Index joint) {
    return joint == 0 &&
           std::abs(machine.tree.gravity.x()) + std::abs(machine.tree.gravity.y()) < 1;
  };
  const auto long_before = [](const Machine& machine, Index joint) {
    return std::abs(machine.tree.links[at(joint)].position.x()) > 0.1;
  };
  return {{"link_flexibility", carries, link_flexibility},
          {"gravity_spring", {}, gravity_spring},
          {"cable", {}, cable},
          {"base_tilt", upright, base_tilt},
          {"geometry_error", long_before, geometry_error}};
}

}  // namespace blind
