// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <string>
#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// FS sign(dq) + FV dq + OFF of one joint.
GiNaC::ex friction_torque(const CodeLink& link);

/// Writes the friction torque FS sign(dq) + FV dq + OFF of every joint and that of the effects, as
/// the output array "tau".
void write_friction(Trace& trace, const CodeModel& code);

/// Writes the torque of the effects alone, as the output array "tau".
void write_effect_torque(Trace& trace, const CodeModel& code);

/// Why a robot has no function of its effects: none of them runs in a controller.
std::string why_no_effects(const CodeModel& code);

/// What the function friction reads: dq, and q and ddq where effects read them.
std::vector<std::string_view> friction_inputs(const CodeModel& code);

}  // namespace dyngen
