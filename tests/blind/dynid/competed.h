// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/diagnosis/competition/search.h"

namespace blind {

/// Competes as a diagnosis does by default.
void compete_by_default(dyngen::runtime::Search& search);

}  // namespace blind
