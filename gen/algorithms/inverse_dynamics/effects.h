// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "gen/algorithms/code_model/code_model.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// Torque of the effects, and what they remember.
struct EffectTorques {
  std::vector<GiNaC::ex> torque;  ///< of each coordinate, N m or N: what the actuator must add
  std::vector<Output> memory;     ///< the members of the state after the call
};

/// Writes the model's effects. With states: these first, a step from the variables of the call
/// before to those of this one, then the torque with the states after it.
///
/// @param load  torque of the rigid links on each coordinate, without rotor inertia and friction;
///              may be empty if no effect reads it
EffectTorques write_effects(Trace& trace, const CodeModel& code,
                            const std::vector<GiNaC::ex>& load);

}  // namespace dyngen
