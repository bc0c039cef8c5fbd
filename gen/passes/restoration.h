// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/passes/network.h"

namespace dyngen {

/// Gives sums of the original that were written where they are read their statements back, where
/// that costs nothing: the code reads as the algorithm does, and long sums wait less.
///
/// @param source  the network before the passes: its nodes have the same numbers
void restore_statements(Network& network, const Network& source);

}  // namespace dyngen
