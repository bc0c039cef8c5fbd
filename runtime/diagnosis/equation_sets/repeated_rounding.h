// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/identification/motion_source.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Whether every period shows the same digits of a joint's position again: accelerations a period
/// apart differ by much less than rounding to `position_step` alone makes them differ from the true
/// ones. No scatter shows such errors, and the mean of other periods has them too. No where no
/// periods are found.
bool repeats_rounding(const MotionSource& source, const EquationRules& rules = {});

}  // namespace dyngen::runtime
