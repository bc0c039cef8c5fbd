// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/diagnosis/names/findings.h"
#include "runtime/report/document.h"
#include "runtime/report/residual_views.h"

namespace dyngen::runtime {

/// Words of an axis: "velocity of joint 2 [rad/s]" of "qd2".
using AxisLabel = std::function<std::string(const std::string& variable)>;

/// What the model alone leaves of a joint over each variable, with what was found drawn over it.
/// @param where  its range is shaded  @param unit  of the joint's torque
ReportChart where_chart(const ResidualView& view, const EffectLocation& where,
                        const AxisLabel& label, const std::string& unit, const std::string& id);

/// What is left without one effect, and the effect with its band.
ReportChart model_chart(const ResidualView& view, const AxisLabel& label, const std::string& unit,
                        const std::string& id);

/// Torque and residuals of one joint in each held-out recording, two panels with one time axis.
/// @param floor  rms of the noise, N m or N; NaN: not known
ReportChart proof_chart(const std::vector<HeldoutView>& heldout, int joint, double floor,
                        const std::string& unit, const std::string& id);

}  // namespace dyngen::runtime
