// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cstddef>

#include "gen/passes/network.h"
#include "gen/trace/trace.h"

namespace dyngen {

/// What C99 promises to tell apart: longer names are not made of parts.
constexpr std::size_t kLongestName = 31;

/// A function as a network: each statement is a node with its name, a sum within a product one
/// without.
Network to_network(const Trace& trace);

/// The function of a network that was made from a trace: what kept its statement stands in its
/// order and section, what is new stands before its first reader and is named by what it is of.
Trace to_trace(const Network& network, const Trace& source);

}  // namespace dyngen
