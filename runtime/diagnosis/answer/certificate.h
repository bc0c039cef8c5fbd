// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/names/findings.h"

namespace dyngen::runtime {

/// What was not found, and the smallest size at which it would have been.
/// @param detectable  lambda that is found nine times in ten
std::vector<CertificateLine> certificate_of(const std::vector<Hypothesis>& hypotheses,
                                            const CompetitionResult& result, double detectable);

}  // namespace dyngen::runtime
