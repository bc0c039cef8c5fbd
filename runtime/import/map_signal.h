// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "runtime/import/map_lengths.h"
#include "runtime/import/map_nodes.h"
#include "runtime/recordings/units.h"

namespace dyngen::runtime {

/// Reads the signals of a map: which columns they are, and what makes values at the joints of them.
class SignalReader {
 public:
  /// @param map  knows its files already   All outlive the reader.
  SignalReader(const ImportMap& map, MapLengths& lengths, MapFaults& faults)
      : map_(&map), lengths_(&lengths), faults_(&faults) {}

  /// @return nothing if the map does not have the key; faults are collected
  std::optional<SignalMap> read(const MapEntries& top, const char* key, ColumnQuantity quantity);

 private:
  void units(const MapEntries& entries, ColumnQuantity quantity, SignalMap& signal);
  void sides(const MapEntries& entries, SignalMap& signal);
  void duty(const MapEntries& entries, SignalMap& signal);
  void conversion(const MapEntries& entries, bool torque, SignalMap& signal);
  void check_keys(const MapEntries& entries, const char* key, ColumnQuantity quantity,
                  const SignalMap& signal);
  PerJoint numbers(const MapEntries& entries, const char* key, MapNumber kind);

  const ImportMap* map_;
  MapLengths* lengths_;
  MapFaults* faults_;
};

/// Key 'file' must be one of the map's files.
void check_file(const MapEntries& entries, const std::vector<FileMap>& files, MapFaults& faults);

}  // namespace dyngen::runtime
