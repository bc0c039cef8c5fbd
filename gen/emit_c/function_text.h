// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/emit_c/emit_c.h"

namespace dyngen {

/// What the function computes, and of which link.
std::string summary_text(const CodeModel& code, const RobotFunction& function);

/// What the function computes, its arguments with their units, and its operation counts.
std::string function_comment(const CodeModel& code, const RobotFunction& function,
                             const EmitOptions& options);

/// "P_FUNCTION void P_id(const double *q, ..., double *tau)", on one line.
std::string signature(const CodeModel& code, const RobotFunction& function,
                      const EmitOptions& options);

/// The comment, the signature and the body.
std::string function_definition(const CodeModel& code, const RobotFunction& function,
                                const EmitOptions& options);

/// The same with a body that calls the twin.
std::string forwarding_definition(const CodeModel& code, const RobotFunction& function,
                                  const EmitOptions& options);

/// "q, dq, ddq, Y": the arguments as they are passed on.
std::string passed_arguments(const CodeModel& code, const RobotFunction& function);

}  // namespace dyngen
