// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/diagnosis/competition/search.h"
#include "runtime/diagnosis/names/findings.h"

namespace dyngen::runtime {

/// The winners with their names settled, tests, places, and sizes of a last fit.
/// @param search  its winners and its fit change where a rival takes a winner's place
std::vector<Finding> found_effects(Search& search, const CompetitionOptions& options,
                                   const CompetitionProgress& progress);

}  // namespace dyngen::runtime
