// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model.h"
#include "gen/algorithms/link_form.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// The form of the recursion that needs the fewest operations for the rigid body torque, of those
/// that are tried. It is looked for once for each model.
/// @param trace  what stands before it
const RneaForm& choose_form(const Trace& trace, const CodeModel& code);

}  // namespace dyngen
