// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/trace/cheapest.h"

namespace dyngen {

int cheapest_way(const Trace& trace, int count, const std::function<void(Trace&, int)>& write) {
  int best = 0;
  int fewest = 0;
  for (int way = 0; way < count; ++way) {
    Trace trial = trace;
    write(trial, way);
    trial.drop_dead_code();
    const int operations = trial.count().total();
    if (way > 0 && operations >= fewest) continue;
    best = way;
    fewest = operations;
  }
  return best;
}

}  // namespace dyngen
