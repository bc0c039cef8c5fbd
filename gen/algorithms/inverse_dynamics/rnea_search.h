// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/algorithms/inverse_dynamics/rnea.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes tau as write_rnea() does, in the form that needs the fewest operations for the rigid body
/// torque, of those that are tried. It is looked for once for each model.
void write_shortest_rnea(Trace& trace, const CodeModel& code, const RneaTerms& terms);

}  // namespace dyngen
