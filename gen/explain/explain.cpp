// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/explain/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "gen/base_parameters/base_parameters.h"
#include "gen/explain/arm_text.h"
#include "gen/explain/bodies_text.h"
#include "gen/explain/grouping_text.h"
#include "gen/explain/place_text.h"
#include "gen/explain/text.h"
#include "gen/explain/visibility.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

/// The robot with a symbol for every length that is not zero, so that formulas show it.
RobotModel with_symbolic_lengths(RobotModel model) {
  for (JointModel& joint : model.joints) {
    for (Quantity* length : {&joint.d, &joint.r}) {
      if (!length->known_zero()) length->unknown = true;
    }
  }
  return model;
}

bool same_set(const Regrouping& a, const Regrouping& b) {
  return std::equal(
      a.parameters.begin(), a.parameters.end(), b.parameters.begin(), b.parameters.end(),
      [](const GroupedParameter& x, const GroupedParameter& y) { return x.column == y.column; });
}

std::string value_text(const GroupedParameter& parameter, const SymbolicRobot& robot) {
  const GiNaC::ex value = with_known_values(parameter.value, robot);
  const bool revolute = robot.link(parameter.column.link).type != JointType::kPrismatic;
  const std::string_view unit = chi_unit(parameter.column.kind, revolute);
  if (!is_number(value)) return fmt::format("[{}]", unit);
  return fmt::format("[{:.6g} {}]", to_double(value), unit);
}

/// "d3 = 0.4318 m": the lengths in the formulas.
std::string lengths_text(const RobotModel& model) {
  std::string text;
  const auto add = [&](const char* name, int j, const Quantity& length) {
    if (length.known_zero()) return;
    text +=
        fmt::format("{}{}{} = {}", text.empty() ? "" : ", ", name, j,
                    length.unknown ? "run-time" : fmt::format("{:.6g} m", to_double(length.value)));
  };
  for (int j = 1; j <= model.size(); ++j) {
    add("d", j, model.joint(j).d);
    add("r", j, model.joint(j).r);
  }
  return text;
}

std::string base_text(const RobotModel& model, const SymbolicRobot& robot, const Regrouping& base) {
  // the same set with lengths as symbols, if the geometry is not a special one
  const SymbolicRobot general = make_symbolic(with_symbolic_lengths(model));
  const Regrouping formulas = regroup(general);
  const bool symbolic = same_set(base, formulas);
  std::string text = fmt::format("\nBase parameters: {}\n", base.parameters.size());
  for (std::size_t i = 0; i < base.parameters.size(); ++i) {
    const GroupedParameter& parameter = base.parameters[i];
    const std::string formula = symbolic ? grouping_formula(formulas.parameters[i].value, general)
                                         : grouping_formula(parameter.value, robot);
    const std::string name = parameter.name();
    text += fill_lines(fmt::format("  {} = ", name), formula + " " + value_text(parameter, robot),
                       name.size() + 5);
  }
  const std::string lengths = lengths_text(model);
  if (symbolic && !lengths.empty()) text += fill_lines("  with ", lengths, 6);
  if (!symbolic) {
    text +=
        fill_lines("  ",
                   "The lengths of this arm are special: with others the set would be larger. The "
                   "formulas hold for these lengths, in numbers.",
                   2);
  }
  for (const Column& column : base.unsolved) {
    text += fill_lines("  ",
                       fmt::format("Warning: {} depends on others by coefficients that are no "
                                   "polynomials in the run-time lengths. It stays apart: the set "
                                   "is larger than it need be.",
                                   chi_name(column.kind, column.link)),
                       2);
  }
  return text;
}

std::string standing_text(const SymbolicRobot& robot) {
  std::vector<std::string> names;
  for (const GroupedParameter& parameter : regroup(robot, Motions::kStanding).parameters) {
    if (index(parameter.column.kind) < kInertialCount) names.push_back(parameter.name());
  }
  return fill_lines(fmt::format("\nGravity alone shows {}: ", names.size()), list_names(names), 2);
}

std::string visibility_text(const SymbolicRobot& robot, const Regrouping& base) {
  const Visibility seen = visibility(robot, base);
  std::string text = "\nStandard parameters of the file\n";
  if (!seen.alone.empty()) {
    text += fill_lines("  identifiable alone: ", list_names(seen.alone), 4);
  }
  if (!seen.in_sums.empty()) text += "  only in sums:\n";
  // those of the same base parameters together
  std::vector<std::pair<std::vector<std::string>, std::vector<std::string>>> together;
  for (const Visibility::InSums& entry : seen.in_sums) {
    const auto same = std::find_if(together.begin(), together.end(),
                                   [&](const auto& group) { return group.first == entry.base; });
    if (same == together.end()) {
      together.push_back({entry.base, {entry.name}});
    } else {
      same->second.push_back(entry.name);
    }
  }
  for (const auto& [sums, names] : together) {
    text += fill_lines("   ", list_names(names) + " in " + list_names(sums), 6);
  }
  if (!seen.hidden.empty()) text += "  not at all:\n";
  for (const Visibility::Hidden& hidden : seen.hidden) {
    text += fill_lines("   ", list_names(hidden.names) + ": " + hidden.reason, 6);
  }
  return text;
}

}  // namespace

std::string explain(const RobotModel& model) {
  const SymbolicRobot robot = make_symbolic(model);
  const Regrouping base = regroup(robot);
  std::string text = fmt::format("{}: {} {}, {} moving\n", model.name, model.size(),
                                 model.size() == 1 ? "joint" : "joints", model.coordinate_count);
  if (model.convention == DhConvention::kStandard) {
    text += fill_lines("",
                       "The file is in standard (distal) frames; the frames below are the modified "
                       "(proximal) ones of the same arm. Parameters are the file's.",
                       0);
  }
  if (model.parameters == ParameterMeaning::kBase) {
    text += fill_lines("",
                       "The numbers of the file are base parameters: sums of many bodies' "
                       "parameters, each where one of them stands. Alone they are no body's.",
                       0);
  }
  text += describe_arm(robot);
  text += bodies_text(model);
  text += describe_places(make_posture(model));
  text += base_text(model, robot, base);
  text += visibility_text(robot, base);
  return text + standing_text(robot);
}

}  // namespace dyngen
