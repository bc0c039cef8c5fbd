// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/names/findings.h"
#include "runtime/diagnosis/scans/screening.h"

namespace dyngen::runtime {

/// Effects whose columns are columns of the model, on any data: constant torque, a constant
/// payload, a gravity moment, the scale of all torque. Effects of one joint that are absorbed by
/// the same parameters are one entry.
std::vector<Undecidable> undecidable_effects(const std::vector<Hypothesis>& hypotheses,
                                             const Screening& screening, const LinearModel& model);

}  // namespace dyngen::runtime
