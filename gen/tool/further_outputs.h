// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/robot_file/robot_file.h"
#include "gen/tool/options.h"
#include "gen/tool/output_files.h"

namespace dyngen {

/// --numpy and --matlab: the functions as scripts. Functions that remember the call before are left
/// out, and told of by the generator's options.
/// @throws ModelError  if such a function was asked for by its name
std::vector<OutputFile> script_files(const ToolOptions& options, const CodeModel& code,
                                     const std::vector<RobotFunction>& functions);

/// --latex
OutputFile latex_file(const ToolOptions& options, const RobotModel& model);

/// --eval: what is to be printed. @throws ModelError
std::string evaluated(const ToolOptions& options, const RobotModel& model, const RobotFile& file);

/// --compare: the same. @throws ModelError
std::string compared(const ToolOptions& options, const RobotModel& model, const RobotFile& file);

}  // namespace dyngen
