// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/explain/base_formulas.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/explain/grouping_text.h"
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

std::vector<FormulaLength> lengths_of(const RobotModel& model) {
  std::vector<FormulaLength> lengths;
  const auto add = [&](const char* name, int j, const Quantity& length) {
    if (length.known_zero()) return;
    FormulaLength entry{fmt::format("{}{}", name, j), {}};
    if (!length.unknown) entry.value = to_double(length.value);
    lengths.push_back(std::move(entry));
  };
  for (int j = 1; j <= model.size(); ++j) {
    add("d", j, model.joint(j).d);
    add("r", j, model.joint(j).r);
  }
  return lengths;
}

}  // namespace

BaseFormulas base_formulas(const RobotModel& model, const SymbolicRobot& robot,
                           const Regrouping& base) {
  // the same set with lengths as symbols, if the geometry is not a special one
  const SymbolicRobot general = make_symbolic(with_symbolic_lengths(model));
  const Regrouping formulas = regroup(general);
  BaseFormulas result;
  result.symbolic = same_set(base, formulas);
  for (std::size_t i = 0; i < base.parameters.size(); ++i) {
    const GroupedParameter& parameter = base.parameters[i];
    BaseFormula entry;
    entry.name = parameter.name();
    entry.formula = result.symbolic ? grouping_formula(formulas.parameters[i].value, general)
                                    : grouping_formula(parameter.value, robot);
    const GiNaC::ex value = with_known_values(parameter.value, robot);
    if (is_number(value)) entry.value = to_double(value);
    const bool revolute = robot.link(parameter.column.link).type != JointType::kPrismatic;
    entry.unit = chi_unit(parameter.column.kind, revolute);
    result.parameters.push_back(std::move(entry));
  }
  if (result.symbolic) result.lengths = lengths_of(model);
  return result;
}

}  // namespace dyngen
