// SPDX-License-Identifier: MIT
#pragma once

#include <yaml-cpp/yaml.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/import/import_map.h"
#include "runtime/import/map_number.h"

namespace dyngen::runtime {

/// Joints of one robot, at most.
inline constexpr int kMostImportedJoints = 1000;

/// What is wrong with a map, collected.
class MapFaults {
 public:
  explicit MapFaults(std::string name) : name_(std::move(name)) {}

  void add(const MapPlace& place, const std::string& message);
  [[nodiscard]] bool empty() const { return lines_.empty(); }
  /// @throws ImportError  if there are any
  void check() const;

 private:
  std::string name_;
  std::vector<std::string> lines_;
  std::size_t left_out_ = 0;
};

MapPlace place_of(const YAML::Node& node);

/// The entries of a YAML mapping, each asked for by its key.
class MapEntries {
 public:
  /// @param what   the mapping is about, for messages: "time"
  /// @param keys   all that it may have
  MapEntries(const YAML::Node& node, std::string what, std::initializer_list<const char*> keys,
             MapFaults& faults);

  [[nodiscard]] const MapPlace& place() const { return place_; }
  [[nodiscard]] bool has(std::string_view key) const { return find(key) != nullptr; }
  [[nodiscard]] MapPlace place_of_value(std::string_view key) const;
  /// Of each value of a list; of the value alone where it is no list.
  [[nodiscard]] std::vector<MapPlace> places_of_values(std::string_view key) const;
  /// Nothing if the key is absent.
  [[nodiscard]] const YAML::Node* find(std::string_view key) const;

  /// Each is its default where the key is absent or its value is wrong, which is told.
  [[nodiscard]] std::string text(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> texts(std::string_view key) const;
  [[nodiscard]] ColumnNames columns(std::string_view key) const;
  [[nodiscard]] std::optional<double> number(std::string_view key, MapNumber kind) const;
  [[nodiscard]] PerJoint numbers(std::string_view key, MapNumber kind) const;
  /// Units as they stand behind the numbers of a key, empty where there are none.
  [[nodiscard]] std::vector<std::string> units_of_numbers(std::string_view key,
                                                          MapNumber kind) const;
  [[nodiscard]] std::optional<double> number_of(const YAML::Node& node, MapNumber kind) const;

 private:
  [[nodiscard]] std::optional<std::string> scalar(const YAML::Node& node,
                                                  const std::string& what) const;

  std::string what_;
  MapPlace place_;
  std::vector<std::pair<std::string, YAML::Node>> entries_;
  MapFaults* faults_;
};

}  // namespace dyngen::runtime
