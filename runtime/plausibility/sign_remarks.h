// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/plausibility/judge.h"
#include "runtime/plausibility/trial_fit.h"

namespace dyngen::runtime {

/// Joints whose fitted inertia is negative, or whose friction drives them, while a turned sign
/// mends it and fits as well. Such a recording can fit perfectly.
void add_sign_remarks(const LinearModel& model, const TrialSamples& samples, const TrialFit& plain,
                      std::vector<Remark>& remarks);

}  // namespace dyngen::runtime
