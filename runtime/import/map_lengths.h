// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "runtime/import/map_nodes.h"

namespace dyngen::runtime {

/// Lists of a map that have one entry for each joint: all must be of one length.
class MapLengths {
 public:
  /// @param is_list  in brackets: one of a list is not one for all
  void note(const MapPlace& place, std::string what, std::size_t length, bool is_list = false) {
    if (length > 1 || (length == 1 && is_list))
      lengths_.push_back({place, std::move(what), length});
  }
  /// The same of a key's value.
  void note(const MapEntries& entries, const char* key, std::string what, std::size_t length) {
    const YAML::Node* node = entries.find(key);
    note(entries.place_of_value(key), std::move(what), length,
         node != nullptr && node->IsSequence());
  }
  /// @param map  learns from the first list how many joints there are, if nothing else says it
  void check(ImportMap& map, MapFaults& faults) const;

 private:
  struct Length {
    MapPlace place;
    std::string what;
    std::size_t length;
  };
  std::vector<Length> lengths_;
};

}  // namespace dyngen::runtime
