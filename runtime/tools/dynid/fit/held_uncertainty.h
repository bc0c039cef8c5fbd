// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/effects/effect_fit.h"
#include "runtime/identification/motion_source.h"
#include "runtime/tools/dynid/fit/fit_report.h"
#include "runtime/tools/dynid/options/options.h"

namespace dyngen::runtime {

/// Adds to standard deviations what the deviations of held numbers make of them. The estimate moves
/// with a held number h by d beta / d h = -(W'W)^-1 W'w, where W are the equations' columns and w
/// is the torque of one unit of h; deviations of different numbers are independent.
void add_held_uncertainty(const std::vector<MotionSource>& train, const ToolOptions& options,
                          FitReport& report);

/// The same of a fit with effects, whose parameters move as the tangent at the estimate says.
void add_held_uncertainty(const DescribedRobot& robot, const EffectRecordings& data,
                          EffectFit& fit);

/// Percentages of a fit with held numbers are those of the torque that was recorded, not of what
/// the numbers leave of it.
void take_percentages_of_recorded_torque(const std::vector<MotionSource>& train,
                                         const std::vector<MotionSource>& heldout,
                                         const ToolOptions& options, FitReport& report);

}  // namespace dyngen::runtime
