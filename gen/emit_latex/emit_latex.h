// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/explain/base_formulas.h"
#include "gen/functions/functions.h"
#include "gen/model/robot_model.h"

namespace dyngen {

/// A LaTeX document (pdflatex, amsmath) of a robot: its table of joints, the base parameters with
/// their formulas, and its inverse dynamics as the straight-line program of the recursion, with
/// parameters as symbols.
/// @param code      with parameters read from chi
/// @param id        its function id, of write_plain_function()
/// @param formulas  of the model
std::string emit_latex(const RobotModel& model, const CodeModel& code, const RobotFunction& id,
                       const BaseFormulas& formulas);

}  // namespace dyngen
