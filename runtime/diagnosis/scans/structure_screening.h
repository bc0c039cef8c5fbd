// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/diagnosis/scans/screening.h"

namespace dyngen::runtime {

/// Places of structures that have the same columns on every joint, but for the equations of it that
/// count: functions of the same variables, waves of the same positions. All others are alone.
std::vector<std::vector<std::size_t>> structure_groups(
    const std::vector<GenericStructure>& structures);

/// Results of a group, in its order: columns that are shared are made once.
std::vector<GenericResult> screen_structures(const ScreeningData& data,
                                             ScreeningData::Reader& reader,
                                             const EvidenceSystem& system,
                                             const std::vector<GenericStructure>& structures,
                                             const std::vector<std::size_t>& group,
                                             bool surrogates);

}  // namespace dyngen::runtime
