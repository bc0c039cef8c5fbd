// SPDX-License-Identifier: MIT
#include "runtime/simulation/twisting_effects.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace dyngen::runtime {
namespace {

constexpr std::array<std::string_view, 6> kTwistVariables = {
    "d_q", "d_qd", "d_qdd", "tau_load", "tau_load_rate", "tau_load_acc"};

struct TwistVariable {
  std::string_view name;
  double value;
};

/// The effect's torque where all other variables are 0.
double torque_at(const EffectInstance& effect, std::initializer_list<TwistVariable> given) {
  std::array<double, kTwistVariables.size()> values{};
  for (std::size_t v = 0; v < effect.law.variables.size(); ++v) {
    for (const TwistVariable& variable : given) {
      if (effect.law.variables[v] == variable.name) values[v] = variable.value;
    }
  }
  double torque = 0, rate = 0;
  effect.law.moment(values.data(), effect.parameters.data(), &rate, &torque, &rate);
  return torque;
}

}  // namespace

bool twists_joint(const EffectInstance& effect) {
  const EffectLaw& law = effect.law;
  if (law.kind != EffectKind::kTangent || law.scope != EffectScope::kJoint || effect.joint < 0 ||
      law.outputs != 1 || !law.states.empty() || law.variables.size() != kTwistVariables.size() ||
      !std::all_of(kTwistVariables.begin(), kTwistVariables.end(),
                   [&](std::string_view name) { return law.reads(name); })) {
    return false;
  }
  // without the derivatives of the rigid model there must be nothing
  for (const double load : {-100.0, -1.0, 1.0, 100.0}) {
    if (torque_at(effect, {{"tau_load", load}, {"tau_load_rate", 1}, {"tau_load_acc", 1}}) != 0) {
      return false;
    }
  }
  return true;
}

Twist twist_of(const EffectInstance& effect, double load) {
  return {-torque_at(effect, {{"tau_load", load}, {"d_q", 1}}),
          -torque_at(effect, {{"tau_load", load}, {"tau_load_rate", 1}, {"d_qd", 1}})};
}

}  // namespace dyngen::runtime
