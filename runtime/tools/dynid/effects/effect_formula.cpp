// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_formula.h"

#include <fmt/format.h>

namespace dyngen::runtime {
namespace {

/// What the torque is made of.
std::vector<std::string> definitions(const EffectFile& effect) {
  std::vector<std::string> lines;
  for (const auto& [name, value] : effect.lets) lines.push_back(name + " = " + spell(value));
  for (const EffectState& state : effect.states) {
    std::string line = "d" + state.name + "/dt = " + spell(state.rate);
    if (state.min && state.max) {
      line += ",  " + spell(*state.min) + " <= " + state.name + " <= " + spell(*state.max);
    }
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

std::vector<std::string> equation_lines(const EffectFile& effect) {
  std::vector<std::string> lines = definitions(effect);
  lines.push_back("torque = " + spell(effect.torque[0]));
  if (effect.torque.size() == 2) lines.push_back("torque_other = " + spell(effect.torque[1]));
  if (effect.alignment) {
    lines.push_back(fmt::format(
        "{} of {}", *effect.alignment == ::dyngen::AlignmentOperator::kDelay ? "delay" : "lag",
        effect.alignment_parameter));
  }
  if (!effect.midpoint.empty()) {
    lines.push_back(fmt::format("derivatives further on by {}/2", effect.midpoint));
  }
  return lines;
}

std::string effect_formula(const EffectFile& effect) {
  std::vector<std::string> with = definitions(effect);
  if (effect.torque.size() == 2)
    with.insert(with.begin(), "torque_other = " + spell(effect.torque[1]));
  const std::string torque = spell(effect.torque[0]);
  return with.empty() ? torque : fmt::format("{} where {}", torque, fmt::join(with, ", "));
}

}  // namespace dyngen::runtime
