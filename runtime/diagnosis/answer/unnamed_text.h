// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/names/findings.h"

namespace dyngen::runtime {

/// Structure that no effect explains, in words: joint, variables, size and shape.
std::vector<Unexplained> described(const std::vector<Nameless>& nameless);

}  // namespace dyngen::runtime
