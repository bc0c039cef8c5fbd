// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/emit_c/emit_c.h"

namespace dyngen {

/// "P_FUNCTION void P_id_batch(size_t n, const double *q, ..., double *tau)", on one line.
std::string batch_signature(const CodeModel& code, const RobotFunction& function,
                            const EmitOptions& options);

/// What the function computes and how its arrays are laid out.
std::string batch_comment(const CodeModel& code, const RobotFunction& function,
                          const EmitOptions& options);

/// True if an output of the function does not depend on the sample.
bool writes_constant(const CodeModel& code, const RobotFunction& function,
                     const EmitOptions& options);

/// Two functions: <prefix>_<name>_lanes computes as many samples as a register holds, in the
/// statements of the function for one sample; <prefix>_<name>_batch calls it for all of them.
std::string batch_definition(const CodeModel& code, const RobotFunction& function,
                             const EmitOptions& options);

/// <prefix>_<name>_batch alone, with a body that calls the twin's.
std::string batch_forwarding_definition(const CodeModel& code, const RobotFunction& function,
                                        const EmitOptions& options);

}  // namespace dyngen
