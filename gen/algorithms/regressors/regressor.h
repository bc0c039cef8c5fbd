// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes the regressor Y of inverse dynamics, tau = Y chi, as the output array "Y", row-major:
/// one row per coordinate, one column per entry of chi (0 for a run-time length).
///
/// A column is the torque of a link with one parameter 1 and the others 0. Its wrench in the
/// link's frame has elements of U, WP, the products of W, and VP only; a joint feels the wrench's
/// power on its screw: Y = a . N + b . F. Sources: the moment of unit parameters from Khalil and
/// Dombre 2002, ch. 9; thesis 3.3.2.
void write_regressor(Trace& trace, const CodeModel& code);

/// The same for the base parameters, tau = Y beta; one column per entry of beta.
void write_base_regressor(Trace& trace, const CodeModel& code);

}  // namespace dyngen
