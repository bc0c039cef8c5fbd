// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstdint>

#include "gen/passes/network.h"

namespace dyngen {

/// How long to look for fewer operations.
struct SearchOptions {
  int patience = 2;            ///< tries without a gain, per sum of the program; 0: no search
  std::int64_t work = 500000;  ///< divisors that are looked at in all: about half a second
};

/// Looks for fewer operations where naming divisors one by one stops: writes some sums out where
/// they are read, names divisors again, and keeps what costs no more, until nothing is gained for a
/// while or enough was looked at. The same network gives the same result.
Network searched(const Network& network, const SearchOptions& options);

}  // namespace dyngen
