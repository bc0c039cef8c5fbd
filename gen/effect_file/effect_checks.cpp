// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/effect_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "gen/effect_file/effect_equations.h"
#include "gen/effect_file/effect_unit_checks.h"
#include "gen/effect_file/effect_variables.h"
#include "gen/words/spelling.h"

namespace dyngen {
namespace {

/// Derivatives by what may be further on.
constexpr std::array kDisplacements = {"d_q", "d_alpha", "d_d", "d_theta", "d_r"};

using GiNaC::ex;

class Checks {
 public:
  Checks(EffectFile& effect, Diagnostics& diagnostics)
      : effect_(effect), diagnostics_(diagnostics) {}

  void run() {
    check_names();
    check_parameter_roles();
    check_equation_names();
    if (diagnostics_.has_errors()) return;
    collect_variables();
    check_kind();
    check_plot();
    check_effect_units(effect_, JointUnits::kRevolute, diagnostics_);
    if (!effect_.revolute_only && !diagnostics_.has_errors()) {
      check_effect_units(effect_, JointUnits::kPrismatic, diagnostics_);
    }
    if (!diagnostics_.has_errors()) check_linearity();
  }

 private:
  void error(SourcePosition at, const std::string& message, const std::string& hint = {},
             int length = 1) {
    diagnostics_.error(at, length, message, hint);
  }

  [[nodiscard]] const EffectParameter* parameter(const std::string& name) const {
    const auto found =
        std::find_if(effect_.parameters.begin(), effect_.parameters.end(),
                     [&](const EffectParameter& entry) { return entry.name == name; });
    return found == effect_.parameters.end() ? nullptr : &*found;
  }
  [[nodiscard]] const EffectState* state(const std::string& name) const {
    const auto found = std::find_if(effect_.states.begin(), effect_.states.end(),
                                    [&](const EffectState& entry) { return entry.name == name; });
    return found == effect_.states.end() ? nullptr : &*found;
  }

  /// A name that the file gives must be new.
  void declare(const std::string& name, SourcePosition at, std::set<std::string>& taken) {
    const int length = static_cast<int>(name.size());
    if (find_effect_variable(name) != nullptr) {
      error(at, fmt::format("'{}' is the name of a variable already", name), "take another name",
            length);
    } else if (effect_call_arguments(name) > 0 || name == "pi" || name == "joint" ||
               name == "other") {
      error(at, fmt::format("'{}' has a meaning already", name), "take another name", length);
    } else if (!taken.insert(name).second) {
      error(at, fmt::format("'{}' stands twice", name), "each name is given once", length);
    }
  }

  void check_names() {
    std::set<std::string> taken;
    for (const EffectParameter& entry : effect_.parameters) {
      declare(entry.name, entry.position, taken);
    }
    for (const EffectState& entry : effect_.states) declare(entry.name, entry.position, taken);
    for (const auto& [name, value] : effect_.lets) declare(name, value.position, taken);
    if (effect_.parameters.empty()) {
      error({1, 1}, "the effect has no parameter", "expected one at least: its size");
    }
  }

  void check_parameter_roles() {
    for (const EffectParameter& entry : effect_.parameters) {
      if (entry.role == ParameterRole::kScanned && (entry.grid == 0 || !entry.min || !entry.max)) {
        error(entry.position,
              fmt::format("'{}' is scanned and lacks grid=, min= or max=", entry.name),
              "how many values are tried, and between which");
      }
      if (entry.role != ParameterRole::kScanned && entry.grid != 0) {
        error(entry.position, fmt::format("'{}' has grid= and is not scanned", entry.name));
      }
    }
    const std::string& name = effect_.alignment_parameter;
    if (effect_.alignment && parameter(name) == nullptr) {
      error({1, 1}, fmt::format("row 'align' names '{}', which is no parameter", name));
    }
    const std::string& position = effect_.midpoint;
    if (!position.empty() && parameter(position) == nullptr) {
      error({1, 1}, fmt::format("row 'midpoint' names '{}', which is no parameter", position));
    }
  }

  /// @param known  whether a name may stand here
  template <typename Known>
  void check_expression_names(const EffectExpression& expression, std::string_view where,
                              const Known& known, const std::vector<std::string>& candidates) {
    if (expression.kind == EffectExpression::Kind::kName && expression.name != "pi" &&
        !known(expression.name)) {
      std::vector<std::string_view> views(candidates.begin(), candidates.end());
      const std::string_view near = nearest_word(expression.name, views);
      error(expression.position,
            fmt::format("unknown name '{}' in '{}'", printable(expression.name), where),
            near.empty() ? "see the table of variables in docs/reference/effect_file.md"
                         : fmt::format("did you mean '{}'?", near),
            expression.length);
    }
    for (const EffectExpression& operand : expression.operands) {
      check_expression_names(operand, where, known, candidates);
    }
  }

  void check_equation_names() {
    std::vector<std::string> own;
    for (const EffectParameter& entry : effect_.parameters) own.push_back(entry.name);
    for (const EffectState& entry : effect_.states) own.push_back(entry.name);
    std::vector<std::string> first;  // what a start may read: fits do not follow parameters there
    for (const EffectVariable& entry : effect_variables()) first.emplace_back(entry.name);
    std::vector<std::string> scales;
    for (const EffectScale& scale : effect_scales()) scales.emplace_back(scale.name);
    std::vector<std::string> candidates = own;
    for (const EffectVariable& entry : effect_variables()) candidates.emplace_back(entry.name);

    const auto check = [&](const EffectExpression& expression, std::string_view where,
                           const std::vector<std::string>& known) {
      check_expression_names(
          expression, where,
          [&](const std::string& name) {
            return std::find(known.begin(), known.end(), name) != known.end();
          },
          known);
    };
    for (const auto& [name, value] : effect_.lets) {
      check(value, "let", candidates);
      candidates.push_back(name);  // rows below may use it
    }
    for (const EffectExpression& torque : effect_.torque) check(torque, "torque", candidates);
    for (const EffectState& entry : effect_.states) {
      check(entry.rate, "state", candidates);
      if (entry.min) check(*entry.min, "min", own);
      if (entry.max) check(*entry.max, "max", own);
      if (entry.start) check(*entry.start, "start", first);
    }
    for (const EffectParameter& entry : effect_.parameters) {
      if (entry.has_own_start()) check(entry.start, "start", scales);
      check(entry.typical, "typical", scales);
      if (entry.min) check(*entry.min, "min", scales);
      if (entry.max) check(*entry.max, "max", scales);
    }
    std::vector<std::string> sizes = scales;
    for (const EffectParameter& entry : effect_.parameters) sizes.push_back(entry.name);
    for (const EffectCondition& entry : effect_.requirements) {
      check(entry.left, "require", sizes);
      check(entry.right, "require", sizes);
    }
    for (const EffectCondition& entry : effect_.falsifiers) {
      check(entry.left, "falsifier", sizes);
      check(entry.right, "falsifier", sizes);
    }
    for (const EffectCondition& entry : effect_.usual) {
      check(entry.left, "usual", sizes);
      check(entry.right, "usual", sizes);
    }
  }

  void add_names(const EffectExpression& expression, std::set<std::string>& names) const {
    for (const std::string& name : names_in(expression)) {
      const auto let = std::find_if(effect_.lets.begin(), effect_.lets.end(),
                                    [&](const auto& entry) { return entry.first == name; });
      if (let != effect_.lets.end()) {
        used_lets_.insert(name);
        add_names(let->second, names);
      } else {
        names.insert(name);
      }
    }
  }

  /// Variables that the equations read. sign(qd) reads sign_qd, and may be all that reads qd.
  void collect_variables() {
    std::set<std::string> names;
    for (const EffectExpression& torque : effect_.torque) add_names(torque, names);
    for (const EffectState& entry : effect_.states) add_names(entry.rate, names);
    std::set<std::string> read;
    const EffectValues record = [&](const std::string& name) {
      read.insert(name);
      return ex(GiNaC::symbol(name));
    };
    (void)effect_torque(effect_, record);
    (void)state_rates(effect_, record);
    (void)state_limits(effect_, record);
    for (const EffectState& entry : effect_.states) {
      if (entry.start) add_names(*entry.start, read);
    }
    for (const EffectVariable& entry : effect_variables()) {
      if (read.contains(std::string(entry.name))) effect_.variables.emplace_back(entry.name);
    }
    for (const auto& [name, value] : effect_.lets) {
      if (!used_lets_.contains(name)) {
        error(value.position, fmt::format("'{}' is not used", name), "leave the row out");
      }
    }
    for (const EffectParameter& entry : effect_.parameters) {
      if (!read.contains(entry.name)) {
        error(entry.position, fmt::format("parameter '{}' is not used", entry.name), "",
              static_cast<int>(entry.name.size()));
      }
    }
    for (const EffectState& entry : effect_.states) {
      if (!names.contains(entry.name)) {
        error(entry.position, fmt::format("state '{}' is not used", entry.name));
      }
    }
  }

  [[nodiscard]] bool reads(VariableSource source) const {
    return std::any_of(
        effect_.variables.begin(), effect_.variables.end(),
        [&](const std::string& name) { return find_effect_variable(name)->source == source; });
  }

  void check_kind() {
    const SourcePosition at{1, 1};
    const bool stateful = !effect_.states.empty();
    const bool tangent = reads(VariableSource::kTangent) || reads(VariableSource::kEveryJoint);
    const bool aligned = effect_.alignment.has_value();
    if (stateful != (effect_.kind == EffectKind::kStateful)) {
      error(at, stateful ? "the effect has states: expected 'kind stateful'"
                         : "'kind stateful' without a row 'state'");
    }
    if (effect_.kind == EffectKind::kAlgebraic && tangent) {
      error(at, "the effect reads derivatives of the rigid model: expected 'kind tangent'");
    }
    if (effect_.kind == EffectKind::kTangent && !tangent) {
      error(at, "'kind tangent' without a derivative of the rigid model in its torque");
    }
    if (aligned != (effect_.kind == EffectKind::kAlignment)) {
      error(at, aligned ? "row 'align' goes with 'kind alignment'"
                        : "'kind alignment' without a row 'align'");
    }
    const bool displaced = std::any_of(
        effect_.variables.begin(), effect_.variables.end(), [](const std::string& variable) {
          return std::find(kDisplacements.begin(), kDisplacements.end(), variable) !=
                 kDisplacements.end();
        });
    if (!effect_.midpoint.empty() && !(displaced && effect_.scope == EffectScope::kJoint)) {
      error(at, fmt::format("row 'midpoint' goes with 'scope joint' and a torque of {}",
                            fmt::join(kDisplacements, ", ")));
    }
    const bool pair = effect_.scope == EffectScope::kPair;
    const bool partner =
        std::any_of(effect_.variables.begin(), effect_.variables.end(),
                    [](const std::string& name) { return find_effect_variable(name)->of_partner; });
    if (partner && !pair) error(at, "the effect reads another joint: expected 'scope pair'");
    if (pair && !partner) error(at, "'scope pair' without a variable of the other joint");
    if (effect_.torque.size() == 2 && !pair) {
      error(effect_.torque[1].position, "'torque_other' goes with 'scope pair'");
    }
    if (effect_.scope == EffectScope::kRobot && !tangent && !aligned) {
      error(at, "'scope robot' goes with effects that are made of the rigid model");
    }
  }

  void check_plot() {
    if (effect_.plot == "distance" || effect_.plot == "frequency") return;
    const EffectVariable* variable = find_effect_variable(effect_.plot);
    if (variable == nullptr) {
      error({1, 1}, fmt::format("row 'plot' names '{}', which is no variable", effect_.plot),
            "expected a variable, or distance: travelled since the last reversal");
    }
  }

  void check_linearity() {
    std::map<std::string, GiNaC::symbol> symbols;
    const EffectValues values = [&](const std::string& name) {
      return ex(symbols.try_emplace(name, name).first->second);
    };
    std::vector<ex> equations = effect_torque(effect_, values);
    const std::size_t torques = equations.size();
    for (const ex& rate : state_rates(effect_, values)) equations.push_back(rate);
    for (const StateLimits& limits : state_limits(effect_, values)) {
      if (limits.min) equations.push_back(*limits.min);
      if (limits.max) equations.push_back(*limits.max);
    }
    for (const EffectParameter& entry : effect_.parameters) {
      if (entry.role != ParameterRole::kLinear) continue;
      const GiNaC::symbol own = symbols.at(entry.name);
      for (std::size_t i = 0; i < equations.size(); ++i) {
        const ex slope = equations[i].diff(own);
        const bool linear = i < torques ? !reads_linear(slope, symbols) : slope.is_zero();
        if (linear) continue;
        error(entry.position,
              fmt::format("the torque is not linear in '{}'{}", entry.name,
                          i < torques ? "" : ", which its states depend on"),
              "expected the role shape", static_cast<int>(entry.name.size()));
        break;
      }
    }
  }

  [[nodiscard]] bool reads_linear(const ex& value,
                                  const std::map<std::string, GiNaC::symbol>& symbols) const {
    const ex expanded = value.expand();
    return std::any_of(
        effect_.parameters.begin(), effect_.parameters.end(), [&](const EffectParameter& entry) {
          return entry.role == ParameterRole::kLinear && expanded.has(symbols.at(entry.name));
        });
  }

  EffectFile& effect_;
  Diagnostics& diagnostics_;
  mutable std::set<std::string> used_lets_;
};

}  // namespace

void check_effect(EffectFile& effect, Diagnostics& diagnostics) {
  Checks(effect, diagnostics).run();
}

}  // namespace dyngen
