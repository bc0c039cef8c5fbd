// SPDX-License-Identifier: MIT
#include "runtime/import/map_lengths.h"

#include <fmt/format.h>

namespace dyngen::runtime {

void MapLengths::check(ImportMap& map, MapFaults& faults) const {
  std::size_t expected = static_cast<std::size_t>(map.joints);
  std::string by = "joints";
  for (const Length& one : lengths_) {
    if (expected == 0) {
      expected = one.length;
      by = fmt::format("{} in line {}", one.what, one.place.line);
    } else if (one.length != expected) {
      faults.add(one.place, fmt::format("found {} {}, expected {} as there are {}, or one for all",
                                        one.length, one.what, expected, by));
    }
  }
  if (map.joints > 0 || lengths_.empty()) return;
  map.joints = static_cast<int>(expected);
  map.joints_place = lengths_.front().place;
  map.joints_by_a_list = true;
}

}  // namespace dyngen::runtime
