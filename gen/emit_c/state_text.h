// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/emit_c/emit_c.h"

namespace dyngen {

/// True if one of the functions has the argument s.
bool any_has_state(const CodeModel& code, const std::vector<RobotFunction>& functions);

/// The struct <prefix>_state of what effects remember between two calls, its sizes, the names of
/// the states, and the declaration of <prefix>_reset.
std::string state_declarations(const CodeModel& code, const EmitOptions& options);

/// The names of the states, and <prefix>_reset.
std::string state_definitions(const CodeModel& code, const EmitOptions& options);

}  // namespace dyngen
