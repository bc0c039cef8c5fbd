// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/trace/trace.h"

namespace dyngen {

/// How long the passes try.
struct OptimiseOptions {
  int patience = 2;  ///< of searched(); 0: name divisors only
};

/// The same function with fewer operations; as it was, statement for statement, if none is saved.
///
/// Values are equal by the laws of algebra; they round differently. Divisions never become more.
Trace optimised(const Trace& trace, const OptimiseOptions& options = {});

}  // namespace dyngen
