// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/changes/change_posterior.h"
#include "runtime/diagnosis/names/findings.h"

namespace dyngen::runtime {

/// Findings of the best set of changes, with parameters, what else they may be, and caveats; the
/// largest lambda first.
/// @param all       runs of the reference and of later sessions
/// @param later     of each run: it is of a later session
/// @param probable  least probability of a change, or of one in its place, that is reported
std::vector<Finding> change_findings(const ChangeSystem& system, const ChangePosterior& posterior,
                                     const EffectRecordings& all, const std::vector<bool>& later,
                                     double probable);

}  // namespace dyngen::runtime
