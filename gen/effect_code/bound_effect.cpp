// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/effect_code/bound_effect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "gen/symbols/exact.h"
#include "gen/words/spelling.h"

namespace dyngen {
namespace {

/// Binds one row; what is wrong goes to the diagnostics of the robot file.
class Binding {
 public:
  /// @param joints  types of all joints; empty: not known, and what names a joint is not checked
  Binding(const EffectRow& row, const std::vector<JointType>& joints,
          const EffectCatalogue& catalogue, Diagnostics& diagnostics)
      : row_(row), joints_(joints), catalogue_(catalogue), diagnostics_(diagnostics) {}

  std::optional<BoundEffect> run() {
    bound_.position = row_.position;
    bound_.file = catalogue_.find(row_.name);
    if (!bound_.file) {
      report_unknown();
      return std::nullopt;
    }
    const EffectScope scope = bound_.file->scope;
    bound_.joint = joint_setting("joint", scope != EffectScope::kRobot);
    bound_.other = joint_setting("other", scope == EffectScope::kPair);
    if (bound_.other != 0 && bound_.other == bound_.joint) {
      error(setting("other")->value.position, setting("other")->value.length,
            fmt::format("joint {} is its own partner", bound_.joint), "expected another joint");
    }
    for (const EffectParameter& parameter : bound_.file->parameters) bind(parameter);
    report_unused();
    return bound_;
  }

 private:
  void error(SourcePosition at, int length, const std::string& message,
             const std::string& hint = {}) {
    diagnostics_.error(at, length, message, hint);
  }
  void error_at_name(const std::string& message, const std::string& hint = {}) {
    error(row_.position, static_cast<int>(row_.name.size()), message, hint);
  }

  [[nodiscard]] const EffectRow::Setting* setting(std::string_view key) const {
    const auto found =
        std::find_if(row_.settings.begin(), row_.settings.end(),
                     [&](const EffectRow::Setting& entry) { return entry.key == key; });
    return found == row_.settings.end() ? nullptr : &*found;
  }

  void report_unknown() {
    std::vector<std::string_view> names;
    for (const auto& effect : catalogue_.all()) names.push_back(effect->name);
    const std::string_view near = nearest_word(row_.name, names);
    error_at_name(fmt::format("unknown effect '{}'", printable(row_.name)),
                  near.empty() ? "known effects: " + comma_list(names)
                               : fmt::format("did you mean '{}'?", near));
  }

  /// The joint that a setting names. @return 0 if there is none, or it is wrong
  int joint_setting(std::string_view key, bool needed) {
    const EffectRow::Setting* found = setting(key);
    if (found == nullptr) {
      if (needed) {
        error_at_name(fmt::format("effect '{}' has no '{}='", row_.name, key),
                      joints_.empty()
                          ? fmt::format("expected {}=1 or another joint", key)
                          : fmt::format("expected {}=1 to {}={}", key, key, joints_.size()));
      }
      return 0;
    }
    if (!needed) {
      error(found->position, static_cast<int>(key.size()),
            fmt::format("effect '{}' has no '{}'", row_.name, key),
            bound_.file->scope == EffectScope::kRobot ? "it acts on the whole robot"
                                                      : "it acts on one joint");
      return 0;
    }
    if (joints_.empty()) return 0;
    const FieldValue& value = found->value;
    const bool whole = !value.unknown && value.value.info(GiNaC::info_flags::integer);
    const double number = value.unknown ? 0 : to_double(value.value);
    if (!whole || number < 1 || number > static_cast<double>(joints_.size())) {
      error(value.position, value.length, fmt::format("'{}' is no joint", printable(value.text)),
            fmt::format("expected a number from 1 to {}", joints_.size()));
      return 0;
    }
    const int joint = static_cast<int>(number);
    const JointType type = joints_[static_cast<std::size_t>(joint - 1)];
    if (type == JointType::kFixed && reads_motion()) {
      error(value.position, value.length, fmt::format("joint {} does not move", joint),
            "an effect acts on a moving joint");
    } else if (bound_.file->revolute_only && type != JointType::kRevolute) {
      error(value.position, value.length, fmt::format("joint {} is prismatic", joint),
            fmt::format("effect '{}' is of revolute joints", row_.name));
    }
    return joint;
  }

  /// A force on a link asks for no motion of its joint.
  [[nodiscard]] bool reads_motion() const {
    const auto& names = bound_.file->variables;
    return std::any_of(names.begin(), names.end(), [](const std::string& name) {
      return name != "t" && !name.starts_with("contact_");
    });
  }

  void bind(const EffectParameter& parameter) {
    Quantity quantity;
    quantity.line = row_.position.line;
    const EffectRow::Setting* found = setting(parameter.name);
    if (found != nullptr) {
      quantity.unknown = found->value.unknown;
      quantity.value = found->value.value;
      quantity.line = found->position.line;
      check_bounds(parameter, found->value);
    } else if (const std::optional<GiNaC::ex> start = plain_number(parameter.start);
               start && parameter.role == ParameterRole::kGiven) {
      quantity.value = *start;
    } else {
      quantity.unknown = true;
    }
    bound_.parameters.push_back(std::move(quantity));
  }

  /// The value of an expression without names.
  static std::optional<GiNaC::ex> plain_number(const EffectExpression& expression) {
    for (const std::string& name : names_in(expression)) {
      if (name != "pi") return std::nullopt;
    }
    return to_algebra(expression, [](const std::string&) { return GiNaC::ex(0); });
  }

  void check_bounds(const EffectParameter& parameter, const FieldValue& value) {
    if (value.unknown) return;
    const double number = to_double(value.value);
    const auto check = [&](const std::optional<EffectExpression>& bound, bool lower) {
      if (!bound) return;
      const std::optional<GiNaC::ex> limit = plain_number(*bound);
      if (!limit) return;  // it depends on a recording
      const double edge = to_double(*limit);
      if (lower ? number >= edge : number <= edge) return;
      error(value.position, value.length,
            fmt::format("'{}' is {}: expected {} or {}", parameter.name, printable(value.text),
                        edge, lower ? "more" : "less"),
            parameter.meaning);
    };
    check(parameter.min, true);
    check(parameter.max, false);
  }

  void report_unused() {
    std::vector<std::string_view> names;
    if (bound_.file->scope != EffectScope::kRobot) names.push_back("joint");
    if (bound_.file->scope == EffectScope::kPair) names.push_back("other");
    for (const EffectParameter& parameter : bound_.file->parameters)
      names.push_back(parameter.name);
    for (const EffectRow::Setting& entry : row_.settings) {
      if (entry.key == "joint" || entry.key == "other") continue;
      if (std::find(names.begin(), names.end(), entry.key) != names.end()) continue;
      const std::string_view near = nearest_word(entry.key, names);
      error(entry.position, static_cast<int>(entry.key.size()),
            fmt::format("effect '{}' has no '{}'", row_.name, printable(entry.key)),
            near.empty() ? "it has " + comma_list(names) : fmt::format("did you mean '{}'?", near));
    }
  }

  const EffectRow& row_;
  const std::vector<JointType>& joints_;
  const EffectCatalogue& catalogue_;
  Diagnostics& diagnostics_;
  BoundEffect bound_;
};

/// Types of the joints as far as the rows of a file say them, which may be wrong.
std::vector<JointType> joint_types(const RobotFile& file) {
  std::vector<JointType> types(static_cast<std::size_t>(file.joint_count), JointType::kRevolute);
  const std::vector<FieldValue>& sigma = file.row(RowKey::kSigma).values;
  for (std::size_t i = 0; i < std::min(sigma.size(), types.size()); ++i) {
    for (const JointType type : {JointType::kPrismatic, JointType::kFixed}) {
      if (!sigma[i].unknown && sigma[i].value.is_equal(static_cast<int>(type))) types[i] = type;
    }
  }
  return types;
}

/// What a condition may read that is known of a row: its parameters and its joint's friction.
class KnownNumbers {
 public:
  KnownNumbers(const BoundEffect& effect, const RobotModel& model) {
    for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
      add(effect.file->parameters[k].name, effect.parameters[k]);
    }
    if (effect.joint == 0) return;
    const JointModel& joint = model.joint(effect.joint);
    for (const auto& [name, kind] :
         {std::pair{"Fc", Chi::kFS}, std::pair{"Fv", Chi::kFV}, std::pair{"Ia", Chi::kIA}}) {
      const Quantity& quantity = joint.chi[index(kind)];
      if (quantity.line != 0) add(name, quantity);  // what a file leaves out may be anything
    }
  }

  [[nodiscard]] bool has(const std::string& name) const { return numbers_.contains(name); }
  [[nodiscard]] double at(const std::string& name) const { return numbers_.at(name); }

 private:
  void add(const std::string& name, const Quantity& quantity) {
    if (!quantity.unknown) numbers_.emplace(name, to_double(quantity.value));
  }
  std::map<std::string, double> numbers_ = {{"pi", std::acos(-1.0)}};
};

const EffectRow& row_of(const BoundEffect& effect, const RobotModel& model) {
  return *std::find_if(model.effects.begin(), model.effects.end(), [&](const EffectRow& row) {
    return row.position.line == effect.position.line &&
           row.position.column == effect.position.column;
  });
}

/// Warns where a condition does not hold of the numbers that a row gives.
/// @param expected  "expected": how it asks for them
void check_condition(const BoundEffect& effect, const EffectCondition& condition,
                     std::string_view expected, const RobotModel& model, Diagnostics& diagnostics) {
  const KnownNumbers known(effect, model);
  std::vector<std::string> names = names_in(condition.left);
  for (const std::string& name : names_in(condition.right)) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (!std::all_of(names.begin(), names.end(), [&](const auto& name) { return known.has(name); })) {
    return;
  }
  const auto value_of = [&](const std::string& name) { return known.at(name); };
  const double left = evaluate(condition.left, value_of);
  const double right = evaluate(condition.right, value_of);
  constexpr double kRounded = 1e-9;
  if (!(left > right + kRounded * std::fabs(right))) return;
  SourcePosition place = effect.position;
  int length = static_cast<int>(effect.file->name.size());
  std::string values;
  for (const std::string& name : names) {
    values += fmt::format("{}{} = {:g}", values.empty() ? "" : ", ", name, known.at(name));
    for (const EffectRow::Setting& setting : row_of(effect, model).settings) {
      if (setting.key != name) continue;
      place = setting.value.position;
      length = setting.value.length;
    }
  }
  diagnostics.warning(
      place, length,
      fmt::format("effect '{}' of joint {}: {}: {} {} <= {}", effect.file->name, effect.joint,
                  values, expected, spell(condition.left), spell(condition.right)),
      condition.text);
}

}  // namespace

std::vector<BoundEffect> bind_effects(const RobotModel& model, const EffectCatalogue& catalogue) {
  Diagnostics diagnostics(model.file_name, model.text);
  std::vector<JointType> joints;
  for (const JointModel& joint : model.joints) joints.push_back(joint.type);
  std::vector<BoundEffect> bound;
  for (const EffectRow& row : model.effects) {
    if (auto effect = Binding(row, joints, catalogue, diagnostics).run()) {
      bound.push_back(std::move(*effect));
    }
  }
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
  return bound;
}

void check_effect_rows(const RobotFile& file, const EffectCatalogue& catalogue,
                       Diagnostics& diagnostics) {
  const std::vector<JointType> joints = joint_types(file);
  for (const EffectRow& row : file.effects) Binding(row, joints, catalogue, diagnostics).run();
}

void check_requirements(const std::vector<BoundEffect>& effects, const RobotModel& model,
                        Diagnostics& diagnostics) {
  for (const BoundEffect& effect : effects) {
    for (const EffectCondition& condition : effect.file->requirements) {
      check_condition(effect, condition, "expected", model, diagnostics);
    }
    for (const EffectCondition& condition : effect.file->usual) {
      check_condition(effect, condition, "unusual, such machines have", model, diagnostics);
    }
  }
}

}  // namespace dyngen
