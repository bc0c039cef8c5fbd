// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/code_model/code_effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/diagnostic/assert.h"
#include "gen/effect_file/effect_equations.h"
#include "gen/effect_file/effect_variables.h"
#include "gen/effect_file/units.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

constexpr std::string_view kPartner = "_other";

std::string_view without_partner(std::string_view variable) {
  if (variable.ends_with(kPartner)) variable.remove_suffix(kPartner.size());
  return variable;
}

ex add_member(SymbolTable& inputs, const std::string& name, std::string_view array, int index) {
  SymbolInfo info;
  info.name = name;
  info.kind = SymbolKind::kInput;
  info.array = std::string(array);
  info.index = index;
  return inputs.add(std::move(info));
}

/// Adds one effect after the other.
class EffectBinding {
 public:
  EffectBinding(CodeModel& code, const SymbolicRobot& robot) : code_(code), robot_(robot) {}

  void add(const BoundEffect& bound) {
    CodeEffect effect;
    effect.name = name_of(bound);
    effect.file = bound.file;
    effect.joint = bound.joint;
    effect.other = bound.other;
    for (std::size_t i = 0; i < bound.parameters.size(); ++i) {
      effect.parameters.push_back(
          parameter(effect, bound.file->parameters[i], bound.parameters[i]));
    }
    for (const std::string& variable : bound.file->variables) {
      const std::string_view own = without_partner(variable);
      const int joint = own == variable ? bound.joint : bound.other;
      if (own == "Ia" || own == "tau_load") find_rotor(joint, own == "Ia", bound);
    }
    add_states(effect, bound);
    code_.effects.push_back(std::move(effect));
  }

 private:
  /// Of one effect that stands twice at a joint, the second gets a number.
  std::string name_of(const BoundEffect& bound) {
    std::string name = fmt::format("{}_{}", bound.file->name, bound.joint);
    if (bound.other > 0) name += fmt::format("_{}", bound.other);
    std::string own = name;
    for (int copy = 2; !names_.insert(own).second; ++copy) own = fmt::format("{}_no{}", name, copy);
    return own;
  }

  [[nodiscard]] std::string origin(int line) const {
    const std::string file = std::filesystem::path(code_.file_name).filename().string();
    return line > 0 ? fmt::format("{}:{}", file, line) : file;
  }

  ex parameter(const CodeEffect& effect, const EffectParameter& parameter,
               const Quantity& quantity) {
    const bool revolute = code_.link(effect.joint).type != JointType::kPrismatic;
    const std::string name = effect.name + "_" + parameter.name;
    const std::string unit =
        unit_text(parameter.unit, revolute ? JointUnits::kRevolute : JointUnits::kPrismatic);
    const std::string comment = origin(quantity.line);
    const std::optional<ex> value =
        quantity.unknown ? std::nullopt : std::optional<ex>(quantity.value);
    values_[name] = value;
    if (value && code_.options.parameters == ParameterMode::kBaked) {
      return add_constant(code_.inputs, name, *value, unit, comment);
    }
    return add_chi_entry(code_, {name, unit, comment, value});
  }

  /// Where regrouping has added the rotor inertia to others, the number of the file stands in.
  void find_rotor(int joint, bool needed, const BoundEffect& bound) {
    CodeLink& link = code_.links[static_cast<std::size_t>(joint - 1)];
    if (!link.chi[index(Chi::kIA)].is_zero()) {
      link.rotor = link.chi[index(Chi::kIA)];
      return;
    }
    const auto entry =
        std::find_if(robot_.parameters.begin(), robot_.parameters.end(),
                     [&](const FileSymbol& own) { return own.name == chi_name(Chi::kIA, joint); });
    if (entry == robot_.parameters.end()) return;  // known to be 0
    if (entry->known) {
      link.rotor = add_constant(code_.inputs, fmt::format("rotor_{}", joint), entry->value,
                                entry->unit, origin(entry->line));
      link.grouped_rotor = link.rotor;
      return;
    }
    if (!needed) return;  // it stays in tau_load
    throw ModelError(fmt::format(
        "{}:{}:{}: error: effect '{}' reads the rotor inertia of joint {}, which is unknown and "
        "grouped into another parameter: expected a number in row IA, or --no-regroup\n",
        code_.file_name, bound.position.line, bound.position.column, bound.file->name, joint));
  }

  void add_states(const CodeEffect& effect, const BoundEffect& bound) {
    if (bound.file->states.empty()) return;
    EffectMemory& memory = code_.memory;
    const auto value_in_file = [&](const std::string& name) -> ex {
      for (const EffectParameter& parameter : bound.file->parameters) {
        if (parameter.name != name) continue;
        const std::optional<ex>& value = values_.at(effect.name + "_" + name);
        return value ? *value : ex(GiNaC::symbol(name));
      }
      return GiNaC::symbol(name);
    };
    const std::vector<StateLimits> limits = state_limits(*bound.file, value_in_file);
    for (std::size_t i = 0; i < bound.file->states.size(); ++i) {
      CodeState state;
      state.name = effect.name + "_" + bound.file->states[i].name;
      state.start = nearest_to_zero(limits[i]);
      state.value = add_member(code_.inputs, "s_" + state.name, kStateArray,
                               static_cast<int>(memory.states.size()));
      memory.states.push_back(std::move(state));
    }
    (void)state_rates(*bound.file, [&](const std::string& name) -> ex {
      remember(name, bound);
      return GiNaC::symbol(name);
    });
  }

  /// A limit that is known when the program runs only counts as one that 0 is within.
  static ex nearest_to_zero(const StateLimits& limits) {
    ex start = 0;
    if (limits.max && is_number(*limits.max) && number_sign(*limits.max) < 0) start = *limits.max;
    if (limits.min && is_number(*limits.min) && number_sign(*limits.min) > 0) start = *limits.min;
    return start;
  }

  void remember(const std::string& name, const BoundEffect& bound) {
    const EffectVariable* variable = find_effect_variable(name);
    if (variable == nullptr || variable->source != VariableSource::kMotion) return;
    std::string own(without_partner(name));
    if (own == "sign_qd") own = "qd";
    const int link = variable->of_partner ? bound.other : bound.joint;
    auto& last = code_.memory.last;
    const bool known = std::any_of(last.begin(), last.end(), [&](const auto& entry) {
      return entry.variable == own && entry.link == link;
    });
    if (known) return;
    const ex value = add_member(code_.inputs, fmt::format("s_last_{}_{}", own, link), kLastArray,
                                static_cast<int>(last.size()));
    last.push_back({own, link, value});
  }

  CodeModel& code_;
  const SymbolicRobot& robot_;
  std::set<std::string> names_;
  std::map<std::string, std::optional<ex>> values_;  // of parameters, by their whole names
};

}  // namespace

std::string why_not_in_controller(const EffectFile& effect) {
  if (effect.runs_in_controller()) return {};
  if (effect.kind == EffectKind::kAlignment) return "it shifts a recording in time";
  for (const std::string& name : effect.variables) {
    const VariableSource source = find_effect_variable(name)->source;
    if (source == VariableSource::kTangent || source == VariableSource::kEveryJoint) {
      return "it is made of derivatives of the rigid model";
    }
  }
  for (const std::string& name : effect.variables) {
    if (find_effect_variable(name)->source == VariableSource::kTime) {
      return fmt::format("it reads '{}', which recordings alone have", name);
    }
  }
  return "it is made of derivatives of the rigid model";
}

bool effects_read(const CodeModel& code, const std::vector<std::string_view>& variables) {
  return std::any_of(code.effects.begin(), code.effects.end(), [&](const CodeEffect& effect) {
    const auto& names = effect.file->variables;
    return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return std::find(variables.begin(), variables.end(), without_partner(name)) !=
             variables.end();
    });
  });
}

void add_effects(CodeModel& code, const std::vector<BoundEffect>& effects,
                 const SymbolicRobot& robot) {
  EffectBinding binding(code, robot);
  for (const BoundEffect& effect : effects) {
    const bool moves = effect.joint > 0 && code.link(effect.joint).coordinate >= 0;
    if (effect.file->runs_in_controller() && moves) binding.add(effect);
  }
  if (code.memory.empty()) return;
  code.memory.step = add_member(code.inputs, "s_step", kStepArray, 0);
  code.memory.dt = add_member(code.inputs, "s_dt", kPeriodArray, 0);
}

}  // namespace dyngen
