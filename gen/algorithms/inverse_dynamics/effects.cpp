// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/inverse_dynamics/effects.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "gen/diagnostic/assert.h"
#include "gen/effect_file/effect_equations.h"
#include "gen/effect_file/effect_variables.h"
#include "gen/trace/assign_calls.h"

namespace dyngen {
namespace {

using GiNaC::ex;

class EffectWriting {
 public:
  EffectWriting(Trace& trace, const CodeModel& code, const std::vector<ex>& load)
      : trace_(trace), code_(code), load_(load) {
    result_.torque.assign(code.coordinate_names.size(), 0);
    for (const CodeState& state : code.memory.states) states_.push_back(state.value);
  }

  EffectTorques run() {
    write_middle();
    std::size_t first = 0;  // of the effect's states
    for (const CodeEffect& effect : code_.effects) {
      trace_.section(title(effect));
      write_states(effect, first);
      write_torque(effect, first);
      first += effect.file->states.size();
    }
    remember();
    return std::move(result_);
  }

 private:
  static std::string title(const CodeEffect& effect) {
    std::string text = fmt::format("effect {} of joint {}", effect.file->name, effect.joint);
    if (effect.other > 0) text += fmt::format(" and joint {}", effect.other);
    return text;
  }

  /// A variable of a joint's motion, now. @param name  without "_other"
  ex now(std::string_view name, int joint) {
    const CodeLink& link = code_.link(joint);
    if (name == "q") return link.q;
    if (name == "qd") return link.dq;
    if (name == "qdd") return link.ddq;
    DYNGEN_ASSERT(name == "tau_load" && !load_.empty(), std::string(name));
    const ex& load = load_[static_cast<std::size_t>(link.coordinate)];
    return trace_.assign(fmt::format("load_{}", joint), load - link.grouped_rotor * link.ddq);
  }

  /// The means of what is remembered and what is now.
  void write_middle() {
    if (code_.memory.last.empty()) return;
    trace_.section("in the middle of the step");
    for (const RememberedVariable& last : code_.memory.last) {
      const std::string name = fmt::format("{}_{}", last.variable, last.link);
      const ex sum = trace_.assign("sum_" + name, last.value + now(last.variable, last.link));
      middle_.push_back(trace_.assign("mid_" + name, sum / 2));
    }
  }

  ex in_the_middle(std::string_view name, int joint) const {
    const auto& last = code_.memory.last;
    const auto found = std::find_if(last.begin(), last.end(), [&](const auto& entry) {
      return entry.variable == name && entry.link == joint;
    });
    DYNGEN_ASSERT(found != last.end(), std::string(name));
    return middle_[static_cast<std::size_t>(found - last.begin())];
  }

  /// What stands for a name of the effect's equations.
  /// @param first   of its states
  /// @param middle  variables are those in the middle of the step
  ex value(const CodeEffect& effect, std::size_t first, const std::string& name, bool middle) {
    const EffectFile& file = *effect.file;
    for (std::size_t i = 0; i < file.parameters.size(); ++i) {
      if (file.parameters[i].name == name) return effect.parameters[i];
    }
    for (std::size_t i = 0; i < file.states.size(); ++i) {
      if (file.states[i].name == name) return states_[first + i];
    }
    const EffectVariable* variable = find_effect_variable(name);
    DYNGEN_ASSERT(variable != nullptr, name);
    const int joint = variable->of_partner ? effect.other : effect.joint;
    const CodeLink& link = code_.link(joint);
    if (name == "Fc") return link.chi[index(Chi::kFS)];
    if (name == "Fv") return link.chi[index(Chi::kFV)];
    if (name == "Ia") return link.rotor;
    const auto motion = [&](std::string_view own) {
      return middle ? in_the_middle(own, joint) : now(own, joint);
    };
    if (name == "sign_qd") return GiNaC::csgn(motion("qd"));
    std::string_view own = name;
    if (variable->of_partner) own.remove_suffix(std::string_view("_other").size());
    return motion(own);
  }

  void write_states(const CodeEffect& effect, std::size_t first) {
    if (effect.file->states.empty()) return;
    const std::vector<ex> next = states_after(
        *effect.file, [&](const std::string& name) { return value(effect, first, name, true); },
        code_.memory.step);
    std::vector<ex> written;
    for (std::size_t i = 0; i < next.size(); ++i) {
      const std::string& name = code_.memory.states[first + i].name;
      written.push_back(trace_.assign(name, assign_calls(trace_, name, next[i])));
    }
    for (std::size_t i = 0; i < next.size(); ++i) {
      states_[first + i] = written[i];
      result_.memory.push_back({std::string(kStateArray), static_cast<int>(first + i), written[i]});
    }
  }

  void write_torque(const CodeEffect& effect, std::size_t first) {
    const std::vector<ex> torque = effect_torque(
        *effect.file, [&](const std::string& name) { return value(effect, first, name, false); });
    for (std::size_t i = 0; i < torque.size(); ++i) {
      const int joint = i == 0 ? effect.joint : effect.other;
      const std::string name = effect.name + (i == 0 ? "" : "_other");
      const ex written = assign_calls(trace_, name, torque[i]);
      result_.torque[static_cast<std::size_t>(code_.link(joint).coordinate)] += written;
    }
  }

  void remember() {
    if (code_.memory.empty()) return;
    int place = 0;
    for (const RememberedVariable& last : code_.memory.last) {
      result_.memory.push_back({std::string(kLastArray), place++, now(last.variable, last.link)});
    }
    result_.memory.push_back({std::string(kStepArray), 0, code_.memory.dt});
  }

  Trace& trace_;
  const CodeModel& code_;
  const std::vector<ex>& load_;
  std::vector<ex> middle_;  // of the memory's variables
  std::vector<ex> states_;  // before their step, then after it
  EffectTorques result_;
};

}  // namespace

EffectTorques write_effects(Trace& trace, const CodeModel& code, const std::vector<ex>& load) {
  return EffectWriting(trace, code, load).run();
}

}  // namespace dyngen
