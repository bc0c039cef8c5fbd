// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/import/map_lengths.h"
#include "runtime/import/map_nodes.h"

namespace dyngen::runtime {

/// Reads 'gears' or 'coupling' of a map.
void read_gears(const MapEntries& top, ImportMap& map, MapLengths& lengths, MapFaults& faults);

}  // namespace dyngen::runtime
