// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Writes the torque that holds the arm still, as the output array "tau" (N m, N if prismatic).
///
/// A standing arm pulls at joint j with the weight of all links that it carries: their common mass
/// and first moments are added up from the tips, and gravity is turned from the base up, so no
/// force or moment has to be handed down. With base parameters the masses on revolute joints are 0.
void write_gravity_torque(Trace& trace, const CodeModel& code);

}  // namespace dyngen
