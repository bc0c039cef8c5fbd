// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_programs/effect_programs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "gen/effect_file/effect_equations.h"
#include "gen/symbols/calls.h"
#include "gen/trace/assign_calls.h"
#include "gen/trace/trace.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// Symbols of an effect's variables, parameters and states.
class Symbols {
 public:
  /// @param variables  name of the array of variables: v or m
  Symbols(const EffectFile& effect, const std::string& variables) {
    add(effect.variables, variables, false, variables_);
    std::vector<std::string> names;
    for (const EffectParameter& parameter : effect.parameters) names.push_back(parameter.name);
    add(names, "p", true, parameters_);
    names.clear();
    for (const EffectState& state : effect.states) names.push_back(state.name);
    add(names, "z", false, states_);
    step_ = table_.add(
        {.name = "h", .kind = SymbolKind::kInput, .array = "h", .index = 0, .shared = true});
  }

  [[nodiscard]] const SymbolTable& table() const { return table_; }
  [[nodiscard]] const std::vector<GiNaC::symbol>& variables() const { return variables_; }
  [[nodiscard]] const std::vector<GiNaC::symbol>& parameters() const { return parameters_; }
  [[nodiscard]] const std::vector<GiNaC::symbol>& states() const { return states_; }
  [[nodiscard]] const GiNaC::symbol& step() const { return step_; }
  [[nodiscard]] EffectValues values() const {
    return [this](const std::string& name) { return ex(by_name_.at(name)); };
  }

 private:
  void add(const std::vector<std::string>& names, const std::string& array, bool shared,
           std::vector<GiNaC::symbol>& symbols) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      symbols.push_back(table_.add({.name = array + "_" + names[i],
                                    .kind = SymbolKind::kInput,
                                    .array = array,
                                    .index = static_cast<int>(i),
                                    .shared = shared}));
      by_name_.emplace(names[i], symbols.back());
    }
  }

  SymbolTable table_;
  std::vector<GiNaC::symbol> variables_, parameters_, states_;
  GiNaC::symbol step_;
  std::map<std::string, GiNaC::symbol> by_name_;
};

/// Expressions into one program.
class Writer {
 public:
  explicit Writer(const Symbols& symbols) : trace_(&symbols.table()) {}

  void output(const std::string& array, const std::vector<ex>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) output(array, i, values[i]);
  }
  void output(const std::string& array, std::size_t place, const ex& value) {
    trace_.output(array, static_cast<int>(place),
                  assign_calls(trace_, fmt::format("{}{}", array, place + 1), value));
  }
  Program program() {
    trace_.drop_dead_code();
    return lower(trace_);
  }

 private:
  Trace trace_;
};

Program program_of(const Symbols& symbols, const std::string& array,
                   const std::vector<ex>& values) {
  Writer writer(symbols);
  writer.output(array, values);
  return writer.program();
}

std::vector<ex> slopes(const std::vector<ex>& values, const std::vector<GiNaC::symbol>& by) {
  std::vector<ex> result;
  for (const ex& value : values) {
    for (const GiNaC::symbol& symbol : by) result.push_back(derivative_of(value, symbol));
  }
  return result;
}

bool is_linear(const EffectParameter& parameter) {
  return parameter.role == ParameterRole::kLinear;
}

/// Slopes by linear parameters, each where it stands among those by all.
Program by_linear(const EffectFile& effect, const Symbols& symbols, const std::vector<ex>& torque) {
  Writer writer(symbols);
  const std::size_t count = effect.parameters.size();
  for (std::size_t o = 0; o < torque.size(); ++o) {
    for (std::size_t k = 0; k < count; ++k) {
      if (!is_linear(effect.parameters[k])) continue;
      writer.output("slope", o * count + k, derivative_of(torque[o], symbols.parameters()[k]));
    }
  }
  return writer.program();
}

bool is_proportional(const EffectFile& effect, const Symbols& symbols,
                     const std::vector<ex>& torque) {
  GiNaC::exmap nothing;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    if (is_linear(effect.parameters[k])) nothing[symbols.parameters()[k]] = 0;
  }
  return !nothing.empty() && std::all_of(torque.begin(), torque.end(), [&](const ex& value) {
    return value.subs(nothing).expand().is_zero();
  });
}

/// sign(x) becomes a function without a step.
struct SmoothSign : public GiNaC::map_function {
  ex operator()(const ex& value) override {
    if (call_name(value) == "sign") return GiNaC::tanh(1000 * (*this)(value.op(0)));
    return value.map(*this);
  }
};

}  // namespace

EffectPrograms effect_programs(const EffectFile& effect) {
  EffectPrograms programs;
  const Symbols now(effect, "v");
  const std::vector<ex> torque = effect_torque(effect, now.values());
  programs.torque = program_of(now, "torque", torque);
  programs.by_parameter = program_of(now, "slope", slopes(torque, now.parameters()));
  programs.by_linear = by_linear(effect, now, torque);
  programs.proportional = is_proportional(effect, now, torque);
  programs.by_variable = program_of(now, "slope", slopes(torque, now.variables()));
  programs.by_state = program_of(now, "slope", slopes(torque, now.states()));

  const Symbols middle(effect, "m");
  const std::vector<ex> after = states_after(effect, middle.values(), middle.step());
  programs.step = split_ahead_of(program_of(middle, "z", after), "z");
  Writer step_slopes(middle);
  step_slopes.output("by_z", slopes(after, middle.states()));
  step_slopes.output("by_p", slopes(after, middle.parameters()));
  step_slopes.output("by_m", slopes(after, middle.variables()));
  programs.step_slopes = step_slopes.program();

  SmoothSign smooth;
  const auto smoothed = [&](std::vector<ex> values) {
    for (ex& value : values) value = smooth(value);
    return values;
  };
  Writer moment(now);
  moment.output("torque", smoothed(torque));
  moment.output("rate", smoothed(state_rates(effect, now.values())));
  std::vector<ex> least, most;
  for (const StateLimits& limits : state_limits(effect, now.values())) {
    programs.has_min.push_back(limits.min.has_value());
    programs.has_max.push_back(limits.max.has_value());
    least.push_back(limits.min.value_or(0));
    most.push_back(limits.max.value_or(0));
  }
  moment.output("min", least);
  moment.output("max", most);
  programs.moment = moment.program();
  return programs;
}

}  // namespace dyngen
