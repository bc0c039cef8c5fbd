// SPDX-License-Identifier: MIT
#include "runtime/import/import_map.h"

#include <fmt/format.h>

#include <algorithm>

namespace dyngen::runtime {

double of_joint(const PerJoint& values, std::size_t joint, double otherwise) {
  if (values.empty()) return otherwise;
  return values.size() == 1 ? values.front() : values.at(joint);
}

ImportMap map_of_motion(ImportMap map) {
  if (map.commanded) {
    map.position = std::move(map.commanded);
    map.velocity.reset();
    map.acceleration.reset();
  }
  for (auto* signal :
       {&map.commanded, &map.torque, &map.simulated_torque, &map.link_position, &map.temperature}) {
    signal->reset();
  }
  // files of torques alone need not be there
  const auto is_needed = [&](const FileMap& file) {
    const auto in = [&](const std::optional<SignalMap>& signal) {
      return signal && (signal->file.empty() || signal->file == file.key);
    };
    return in(map.position) || in(map.velocity) || in(map.acceleration) ||
           (!map.runs.file.empty() && map.runs.file == file.key);
  };
  std::erase_if(map.files, [&](const FileMap& file) { return !is_needed(file); });
  map.motion_only = true;
  return map;
}

std::string map_error(const ImportMap& map, const MapPlace& place, const std::string& message) {
  if (place.line == 0) return fmt::format("{}: error: {}", map.name, message);
  return fmt::format("{}:{}:{}: error: {}", map.name, place.line, place.column, message);
}

}  // namespace dyngen::runtime
