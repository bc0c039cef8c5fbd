// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/optimise.h"

#include "gen/passes/conversion.h"
#include "gen/passes/restoration.h"
#include "gen/passes/search.h"

namespace dyngen {

Trace optimised(const Trace& trace, const SearchOptions& options) {
  const Network source = to_network(trace);
  Network network = searched(source, options);
  restore_statements(network, source);
  Trace result = to_trace(network, trace);
  const OperationCount before = trace.count(), after = result.count();
  const bool saves = after.total() < before.total() && after.divisions <= before.divisions;
  return saves ? result : trace;
}

}  // namespace dyngen
