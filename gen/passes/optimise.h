// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/passes/search.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// The same function with fewer operations; as it was, statement for statement, if none is saved.
///
/// Values are equal by the laws of algebra; they round differently. Divisions never become more.
Trace optimised(const Trace& trace, const SearchOptions& options = {});

}  // namespace dyngen
