// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/optimise.h"

#include "gen/passes/conversion.h"
#include "gen/passes/extraction.h"
#include "gen/passes/restoration.h"
#include "gen/passes/simplify.h"

namespace dyngen {

Trace optimised(const Trace& trace) {
  const Network source = to_network(trace);
  Network network = source;
  simplify(network);
  while (true) {
    const int before = operations(network);
    extract_divisors(network);
    simplify(network);
    if (operations(network) >= before) break;
  }
  restore_statements(network, source);
  Trace result = to_trace(network, trace);
  const OperationCount before = trace.count(), after = result.count();
  const bool saves = after.total() < before.total() && after.divisions <= before.divisions;
  return saves ? result : trace;
}

}  // namespace dyngen
