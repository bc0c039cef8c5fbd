// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/effects/effect_law.h"
#include "runtime/simulation/joint_spring.h"

namespace dyngen::runtime {

/// Whether an effect says that a joint's drive is ahead of its link by an amount that depends on
/// the load alone: its torque is
///
///     -(d_q lag + d_qd dlag/dt + d_qdd d2lag/dt2),   lag a function of tau_load
///
/// the first-order change of the links' torque. In a simulation the joint then has a coordinate on
/// either side of its gear.
bool twists_joint(const EffectInstance& effect);

/// The lag of such an effect: what d_q and d_qd have as factors.
Twist twist_of(const EffectInstance& effect, double load);

}  // namespace dyngen::runtime
