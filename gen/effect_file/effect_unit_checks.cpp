// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_file/effect_unit_checks.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>

#include "gen/effect_file/effect_equations.h"
#include "gen/effect_file/effect_variables.h"
#include "gen/effect_file/expression_units.h"

namespace dyngen {
namespace {

bool chooses(const EffectExpression& value) {
  return value.kind == EffectExpression::Kind::kCall &&
         (value.name == "min" || value.name == "max");
}

class UnitChecks {
 public:
  UnitChecks(const EffectFile& effect, JointUnits joint, Diagnostics& diagnostics)
      : effect_(effect), joint_(joint), diagnostics_(diagnostics) {}

  void run() {
    collect_dimensions();
    const Dimension torque = *dimension_of("torque", joint_);
    for (const EffectExpression& value : effect_.torque) expect(value, torque, "the torque");
    for (const EffectState& entry : effect_.states) check_state(entry);
    for (const EffectParameter& entry : effect_.parameters) check_parameter(entry);
    for (const EffectCondition& entry : effect_.requirements) check_condition(entry);
    for (const EffectCondition& entry : effect_.falsifiers) check_condition(entry);
    for (const EffectCondition& entry : effect_.usual) check_condition(entry);
  }

 private:
  void collect_dimensions() {
    for (const EffectScale& entry : effect_scales()) {
      dimensions_[std::string(entry.name)] = *dimension_of(entry.unit, joint_);
    }
    for (const EffectVariable& entry : effect_variables()) {
      dimensions_[std::string(entry.name)] = *dimension_of(entry.unit, joint_);
    }
    for (const EffectParameter& entry : effect_.parameters) {
      add_unit(entry.name, entry.unit, entry.position);
    }
    for (const EffectState& entry : effect_.states) {
      add_unit(entry.name, entry.unit, entry.position);
    }
    for (const auto& [name, value] : effect_.lets) {
      if (const auto dimension = dimension_of(value, of_name_, diagnostics_)) {
        dimensions_[name] = *dimension;
      }
    }
  }

  void add_unit(const std::string& name, const std::string& unit, SourcePosition position) {
    if (const auto dimension = dimension_of(unit, joint_)) {
      dimensions_[name] = *dimension;
      return;
    }
    diagnostics_.error(
        position, 1, fmt::format("'{}' is no unit of '{}'", printable(unit), name),
        "words N m s kg K rad W J Hz 1, position rate acceleration torque, joined by '.' and "
        "'/': torque.s/rad");
  }

  void expect(const EffectExpression& value, const Dimension& wanted, std::string_view what) {
    const auto found = dimension_of(value, of_name_, diagnostics_);
    if (!found || *found == wanted) return;
    diagnostics_.error(
        value.position, value.length,
        fmt::format("{} has the unit {}, expected {}", what, dimension_text(*found),
                    dimension_text(wanted)),
        joint_ == JointUnits::kPrismatic ? "of a prismatic joint; or write 'joints revolute'" : "");
  }

  void check_state(const EffectState& entry) {
    const Dimension own = dimensions_[entry.name];
    expect(entry.rate, own - *dimension_of("s", joint_), "the rate of '" + entry.name + "'");
    if (entry.min) expect(*entry.min, own, "min");
    if (entry.max) expect(*entry.max, own, "max");
    if (entry.start && !is_plain_number(*entry.start)) expect(*entry.start, own, "start");
  }

  void check_parameter(const EffectParameter& entry) {
    const Dimension own = dimensions_[entry.name];
    expect_size(entry.typical, own, "typical");
    if (entry.has_own_start()) expect_size(entry.start, own, "start");
    if (entry.min) expect_size(*entry.min, own, "min");
    if (entry.max) expect_size(*entry.max, own, "max");
  }

  /// A plain number has the parameter's own unit, also as one of two that min() or max() chooses.
  void expect_size(const EffectExpression& value, const Dimension& own, std::string_view what) {
    if (is_plain_number(value)) return;
    if (!chooses(value)) return expect(value, own, what);
    for (const EffectExpression& operand : value.operands) expect_size(operand, own, what);
  }

  void check_condition(const EffectCondition& entry) {
    const auto left = dimension_of(entry.left, of_name_, diagnostics_);
    if (!left || is_plain_number(entry.left) || is_plain_number(entry.right)) return;
    expect(entry.right, *left, "the right side");
  }

  const EffectFile& effect_;
  JointUnits joint_;
  Diagnostics& diagnostics_;
  std::map<std::string, Dimension> dimensions_;
  DimensionOfName of_name_ = [this](const std::string& name) -> std::optional<Dimension> {
    const auto found = dimensions_.find(name);
    if (found == dimensions_.end()) return std::nullopt;
    return found->second;
  };
};

}  // namespace

void check_effect_units(const EffectFile& effect, JointUnits joint, Diagnostics& diagnostics) {
  UnitChecks(effect, joint, diagnostics).run();
}

}  // namespace dyngen
