// SPDX-License-Identifier: MIT
#include <cmath>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

/// A body that the last link takes up; from then on, or for a time.
Truth payload_change(const Machine& machine, Random random, const Schedule& schedule) {
  Truth truth = truth_of("payload_change", -1, "the last link carries s kg from t_on", true);
  const int run = static_cast<int>(random.below(static_cast<std::size_t>(schedule.runs)));
  const double on = random.between(0.25, 0.75) * schedule.duration;
  const Index last = machine.joints() - 1;
  Eigen::Vector3d where;
  for (double& each : where) each = random.between(-1, 1) * machine.arm.size[last];
  where.z() += 2 * machine.arm.size[last];
  truth.typical = machine.arm.mass[last];
  truth.most = 20;
  truth.numbers = {{"run", run}, {"t_on", on}};
  is_called(truth, "M");
  truth.plant = [=](double size, int here, Plant& plant) {
    if (here != run) return;
    const int link = static_cast<int>(plant.carried[at(last)]);
    Inertia load;
    load.mass = size;
    load.com = where;
    load.about_com = size * 1e-3 * Eigen::Matrix3d::Identity();
    const Inertia both = sum({machine.tree.links[at(last)].inertia, load});
    plant.happenings.push_back(
        {on, [engine = plant.engine, link, both] { engine.set_inertia(link, both); }});
  };
  return truth;
}

/// A push against a point of a link that comes and goes.
Truth contact(const Machine& machine, Index joint, Random random, const Schedule& schedule) {
  Truth truth = truth_of("contact", joint, "a push of s N, as a half sine of the time", true);
  const int run = static_cast<int>(random.below(static_cast<std::size_t>(schedule.runs)));
  const double on = random.between(0.2, 0.8) * schedule.duration, lasts = random.between(0.3, 1.2);
  Eigen::Vector3d push, where;
  for (double& each : push) each = random.normal();
  push.normalize();
  for (double& each : where) each = random.between(-1, 1) * machine.arm.size[joint];
  truth.typical = machine.coulomb[joint] / machine.arm.size[joint];
  truth.most = 500;
  truth.numbers = {{"run", run}, {"t_on", on}, {"t_off", on + lasts}};
  truth.plant = [=](double size, int here, Plant& plant) {
    if (here != run) return;
    const int link = static_cast<int>(plant.carried[at(joint)]);
    plant.forces.push_back(
        [=, engine = plant.engine, links = plant.links](const Moment& m, VectorXd& force) {
          if (m.t < on || m.t > on + lasts) return;
          const VectorXd q = m.x.head(links);
          const double now = size * std::sin(kPi * (m.t - on) / lasts);
          force.head(links) += engine.jacobian(q, link, where).transpose() * (now * push);
        });
  };
  return truth;
}

}  // namespace

std::vector<Physics> passing_physics(const Schedule& schedule) {
  const auto once = [](const Machine&, Index joint) { return joint == 0; };
  return {
      {"payload_change", once,
       [schedule](const Machine& machine, Index, Random random) {
         return payload_change(machine, random, schedule);
       }},
      {"contact", [](const Machine& machine, Index joint) { return joint >= machine.joints() / 2; },
       [schedule](const Machine& machine, Index joint, Random random) {
         return contact(machine, joint, random, schedule);
       }}};
}

}  // namespace blind
