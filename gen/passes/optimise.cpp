// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/passes/optimise.h"

#include "gen/passes/conversion.h"
#include "gen/passes/extraction.h"
#include "gen/passes/simplify.h"

namespace dyngen {

Trace optimised(const Trace& trace) {
  Network network = to_network(trace);
  simplify(network);
  while (true) {
    const int before = operations(network);
    extract_divisors(network);
    simplify(network);
    if (operations(network) >= before) break;
  }
  Trace result = to_trace(network, trace);
  const OperationCount before = trace.count(), after = result.count();
  const bool saves = after.total() < before.total() && after.divisions <= before.divisions;
  return saves ? result : trace;
}

}  // namespace dyngen
