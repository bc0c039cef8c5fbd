// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/names/findings.h"

namespace dyngen::runtime {

/// The motion that would separate the names of the first finding that has several; without purpose
/// where every finding has one name.
NextExperiment next_experiment(const std::vector<Finding>& findings);

}  // namespace dyngen::runtime
