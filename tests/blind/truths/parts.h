// SPDX-License-Identifier: MIT
// What the files of truths have in common.
#pragma once

#include <numbers>
#include <utility>

#include "tests/blind/truths/truth.h"

namespace blind {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kPi = std::numbers::pi;

inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

inline Truth truth_of(const std::string& family, Index joint, const std::string& form,
                      bool own_form) {
  Truth truth;
  truth.family = family;
  truth.form = form;
  truth.joint = static_cast<int>(joint) + 1;
  truth.own_form = own_form;
  return truth;
}

/// That the size, times a sign, is what findings call `name`.
inline void is_called(Truth& truth, const std::string& name, double sign = 1) {
  truth.parameters = [=](double size) {
    return std::map<std::string, double>{{name, sign * size}};
  };
}

/// Adds to the strength of a joint's dry friction.
inline void add_strength(Plant& plant, Index joint, std::function<double(const Moment&)> more) {
  auto& strength = plant.friction[at(joint)].strength;
  strength = [old = strength, more = std::move(more)](const Moment& m) { return old(m) + more(m); };
}

/// A torque on the motor of a joint.
inline void add_torque(Plant& plant, Index joint, std::function<double(const Moment&)> torque) {
  plant.forces.push_back([c = plant.drive[at(joint)], torque = std::move(torque)](
                             const Moment& m, VectorXd& force) { force[c] += torque(m); });
}

/// Changes what acts of a joint's command, or what is recorded of it.
inline void change(std::function<VectorXd(const Moment&)>& channel, Index joint,
                   std::function<double(const Moment&, double value)> to) {
  channel = [old = channel, joint, to = std::move(to)](const Moment& m) {
    VectorXd value = old ? old(m) : m.command;
    value[joint] = to(m, value[joint]);
    return value;
  };
}

/// Where the next state will stand in Moment::z.
inline Index next_state(const Plant& plant) { return static_cast<Index>(plant.states.size()); }

}  // namespace blind
