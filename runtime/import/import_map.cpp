// SPDX-License-Identifier: MIT
#include "runtime/import/import_map.h"

#include <fmt/format.h>

namespace dyngen::runtime {

double of_joint(const PerJoint& values, std::size_t joint, double otherwise) {
  if (values.empty()) return otherwise;
  return values.size() == 1 ? values.front() : values.at(joint);
}

std::string map_error(const ImportMap& map, const MapPlace& place, const std::string& message) {
  if (place.line == 0) return fmt::format("{}: error: {}", map.name, message);
  return fmt::format("{}:{}:{}: error: {}", map.name, place.line, place.column, message);
}

}  // namespace dyngen::runtime
