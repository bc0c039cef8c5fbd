// SPDX-License-Identifier: MIT
#include "tests/blind/cases/crowd.h"

#include <algorithm>
#include <stdexcept>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

constexpr std::size_t kFewest = 5, kMany = 12, kMostLoaded = 3;

struct Member {
  std::string family;
  Index joint = 0;
};

/// Joints on which gravity has a torque above a third of their dry friction in some posture.
std::vector<Index> lifting_joints(const Machine& machine, Random& random) {
  const Engine engine = mujoco_engine(machine.tree);
  const Index n = machine.joints();
  VectorXd most = VectorXd::Zero(n);
  constexpr int kPostures = 30;
  for (int i = 0; i < kPostures; ++i) {
    VectorXd q(n);
    for (Index j = 0; j < n; ++j) q[j] = random.between(machine.arm.q_min[j], machine.arm.q_max[j]);
    Dynamics dynamics;
    engine.dynamics(q, VectorXd::Zero(n), dynamics);
    most = most.cwiseMax(dynamics.bias.cwiseAbs());
  }
  std::vector<Index> joints;
  for (Index j = 0; j < n; ++j) {
    if (most[j] > machine.coulomb[j] / 3) joints.push_back(j);
  }
  return joints;
}

template <class T>
void shuffle(std::vector<T>& all, Random& random) {
  for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[random.below(i)]);
}

std::vector<Member> members(const Machine& machine, Random& random) {
  const Index n = machine.joints();
  const auto any = [&](Index joints) {
    return static_cast<Index>(random.below(static_cast<std::size_t>(joints)));
  };
  const bool slides = random.chance(0.5);
  std::vector<Member> all, more;
  for (Index j = 0; j < n; ++j) {
    all.push_back({slides ? "presliding" : "stribeck", j});
    more.push_back({"nonlinear_viscous", j});
  }
  std::vector<Index> loaded = lifting_joints(machine, random);
  shuffle(loaded, random);
  loaded.resize(std::min(loaded.size(), kMostLoaded));
  for (const Index j : loaded) more.push_back({"load_friction", j});
  more.push_back({"torque_ripple", any(n)});
  more.push_back({"cable", any(n)});
  more.push_back({"joint_coupling", any(n - 1)});
  // springs of pre-sliding friction carry all dry friction: there is none that heat could take
  if (!slides) more.push_back({"thermal_drift", any(n)});
  shuffle(more, random);
  const std::size_t count = std::max(kFewest + random.below(kMany - kFewest + 1), all.size() + 2);
  for (const Member& one : more) {
    if (all.size() < count) all.push_back(one);
  }
  return all;
}

}  // namespace

std::vector<Truth> draw_crowd(const Machine& machine, const Schedule& schedule, Random random) {
  std::vector<Physics> physics;
  for (const auto& room : {friction_physics, drive_physics, structure_physics}) {
    const std::vector<Physics> some = room(schedule);
    physics.insert(physics.end(), some.begin(), some.end());
  }
  std::vector<Truth> truths;
  for (const Member& one : members(machine, random)) {
    const auto place = std::find_if(physics.begin(), physics.end(),
                                    [&](const Physics& p) { return p.family == one.family; });
    if (place == physics.end()) throw std::invalid_argument("no physics of " + one.family);
    truths.push_back(place->draw(machine, one.joint, random.part(truths.size())));
  }
  return truths;
}

}  // namespace blind
