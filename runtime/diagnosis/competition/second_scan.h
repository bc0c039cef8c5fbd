// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/diagnosis/competition/competition_data.h"
#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/sought.h"

namespace dyngen::runtime {

/// What is scanned and not fitted (a ratio, an order) was chosen beside a model that lacked the
/// other winners, and by noise that held them: it is chosen again beside all of them. The winners
/// and their places in the fit get the new values; the fit itself has to be made again.
/// @return  whether anything was scanned
bool scan_again(const CompetitionData& data, const Sought& sought, EvidenceSystem::Options options,
                CompetitionResult& result);

}  // namespace dyngen::runtime
