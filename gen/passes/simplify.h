// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "gen/passes/network.h"

namespace dyngen {

/// Takes copies, negations, equal sums and what no output needs away; writes what is read once
/// where it is read, unless a product of sums would have to be written out.
///
/// The operation count falls or stays.
void simplify(Network& network);

}  // namespace dyngen
