// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/passes/network.h"

namespace dyngen {

/// Looks for fewer operations where naming divisors one by one stops: writes some sums out where
/// they are read, names divisors again, and keeps what costs no more, until nothing is gained for a
/// while or enough was looked at. The same network gives the same result.
///
/// @param patience  tries without a gain before it ends, per sum of the program; 0: no search
Network searched(const Network& network, int patience);

}  // namespace dyngen
