// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes the regressor of gravity, gravity(q) = Y beta, as the output array "Y", row-major: one
/// row per coordinate, one column per base parameter (0 for those that gravity does not feel).
///
/// A mass at p loads the joint i with z_i . (p x g) = p . (g x z_i): one vector for each joint,
/// the same for all links that it carries, and for all joints with parallel axes.
void write_gravity_regressor(Trace& trace, const CodeModel& code);

}  // namespace dyngen
