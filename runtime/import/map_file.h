// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "runtime/import/import_map.h"

namespace dyngen::runtime {

/// Whether maps can be read: yaml-cpp is part of this build.
bool import_maps_available();

/// What a map is read for.
enum class MapUse {
  kRecording,  ///< needs positions and torques
  kMotion      ///< needs positions, or what was commanded
};

/// Reads a map (YAML). docs/reference/import.md has all keys. Unknown keys, wrong units, lists of
/// another length than the robot has joints, and questions that were not answered are errors.
/// @throws ImportError  with a line for each fault
ImportMap read_import_map(const std::string& path, MapUse use = MapUse::kRecording);

/// The same of text; `name` stands in messages.
ImportMap parse_import_map(const std::string& text, const std::string& name,
                           MapUse use = MapUse::kRecording);

}  // namespace dyngen::runtime
