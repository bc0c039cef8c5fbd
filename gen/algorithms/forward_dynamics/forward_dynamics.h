// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes ddq = M^-1 (tau - c - g - friction) as the output array "ddq" (rad/s^2, m/s^2 where a
/// joint is prismatic). The wrench on the last link counts where the model has one.
///
/// M by composite bodies, c + g + friction by customised Newton-Euler, and M = L^T D L with one
/// division for each joint. A link that another does not carry has no element in L, and elimination
/// from the tips to the base makes none.
///
/// Source of the factorisation: Featherstone, "Rigid Body Dynamics Algorithms", 2008, ch. 6.
/// @pre why_no_forward_dynamics() is empty. Where the numbers make M singular, ddq is not finite.
void write_forward_dynamics(Trace& trace, const CodeModel& code);

/// Why a robot's accelerations are not determined: some motion moves neither mass nor rotor. Empty
/// if they are.
std::string why_no_forward_dynamics(const CodeModel& code);

}  // namespace dyngen
