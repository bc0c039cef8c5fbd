// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "tests/baselines/column_selection.h"

namespace dyngen::test {

/// Effects as columns at their typical shapes, joints weighted by what the base model leaves.
struct EffectDictionary {
  std::vector<runtime::EffectInstance> effects;  ///< of each column
  ColumnSet set;
};

/// Effects that the base model takes up, or whose signals the recordings lack, are left out.
/// @param hypotheses  their parameters are not read
EffectDictionary effect_dictionary(const std::vector<runtime::EffectInstance>& hypotheses,
                                   const runtime::EffectRecordings& data);

}  // namespace dyngen::test
