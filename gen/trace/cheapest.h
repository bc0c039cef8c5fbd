// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>

#include "gen/trace/trace.h"

namespace dyngen {

/// Of several ways to write the same outputs, the one that needs the fewest operations; of equals
/// the first.
///
/// @param trace  what has been written so far; it is not changed
/// @param count  number of ways, >= 1
/// @param write  writes way 0 .. count - 1 into a copy of the trace, outputs included
int cheapest_way(const Trace& trace, int count, const std::function<void(Trace&, int)>& write);

}  // namespace dyngen
