// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gen/base_parameters/base_parameters.h"
#include "gen/model/robot_model.h"

namespace dyngen {

/// A base parameter as a person reads it.
struct BaseFormula {
  std::string name;             ///< "ZZR2"
  std::string formula;          ///< "ZZ2 + IA2 + d3^2 (M3 + M4)", see grouping_formula()
  std::optional<double> value;  ///< in the numbers of the file; none: something is unknown
  std::string_view unit;
};

/// A length that stands in the formulas.
struct FormulaLength {
  std::string name;             ///< "d3"
  std::optional<double> value;  ///< m; none: known at run time
};

struct BaseFormulas {
  std::vector<BaseFormula> parameters;
  /// Lengths are symbols. False: the lengths of this arm are special, with others the set would be
  /// larger; the formulas hold for these lengths, in numbers.
  bool symbolic = true;
  std::vector<FormulaLength> lengths;  ///< in the order of the file; empty if not symbolic
};

/// @param robot  of the model     @param base  of regroup(robot)
BaseFormulas base_formulas(const RobotModel& model, const SymbolicRobot& robot,
                           const Regrouping& base);

}  // namespace dyngen
