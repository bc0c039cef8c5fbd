// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes the gradient of s = sum_jc A_jc Y_jc, Y the regressor in base parameters, by the
/// positions, velocities and accelerations, as the output arrays "g_q", "g_dq" and "g_ddq". A is an
/// input, row-major as Y: what a criterion of R = sum Y'Y asks of one sample is A = 2 Y dJ/dR.
/// @param code  with the option weights
void write_regressor_gradient(Trace& trace, const CodeModel& code);

/// Why a robot's code has no such function: without the option weights there is no A.
std::string why_no_regressor_gradient(const CodeModel& code);

}  // namespace dyngen
