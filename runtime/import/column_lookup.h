// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/import/import_map.h"
#include "runtime/logs/raw_log.h"
#include "runtime/recordings/units.h"

namespace dyngen::runtime {

/// A log of a recording.
struct OpenedLog {
  std::string path;
  std::string key;  ///< of ImportMap::files; empty: the map has none
  std::unique_ptr<RawLog> log;
};

/// A column of a log.
struct ColumnPlace {
  std::size_t log = 0, table = 0, column = 0;
  std::string name;  ///< as the map asked for it
  std::string unit;  ///< that the log says; empty: none

  [[nodiscard]] bool same_table(const ColumnPlace& other) const {
    return log == other.log && table == other.table;
  }
};

/// A name of a map for a joint (from 0): "Position{n}" becomes "Position3".
std::string column_of_joint(const std::string& pattern, std::size_t joint,
                            const std::vector<std::string>& joint_names);

/// Whether a name stands for a column of each joint.
bool is_column_pattern(const std::string& name);

/// Finds columns of opened logs by the names that a map has for them: the column's own name, with
/// or without a unit in brackets at its end; "table.column" and "table/column"; the table's name if
/// it has one column. Names that several tables have need the map's `table`.
class ColumnLookup {
 public:
  /// All must outlive it.
  /// @param joint_names  for {joint}; may be empty
  ColumnLookup(const ImportMap& map, const std::vector<OpenedLog>& logs,
               const std::vector<std::string>& joint_names)
      : map_(&map), logs_(&logs), joint_names_(&joint_names) {}

  /// @throws ImportError  if several tables have it, or none has and `required`
  [[nodiscard]] std::optional<ColumnPlace> find(const MapPlace& place, const std::string& file,
                                                const std::string& table, const std::string& name,
                                                ColumnQuantity quantity, bool required) const;

  /// One for each joint.
  /// @param joints  0: as many as a pattern finds, or as there are names
  [[nodiscard]] std::vector<ColumnPlace> find_all(const ColumnNames& columns,
                                                  const std::string& file, const std::string& table,
                                                  std::size_t joints,
                                                  ColumnQuantity quantity) const;

  /// The time column in the table of another one; nothing if it has none.
  [[nodiscard]] std::optional<ColumnPlace> clock_of(const ColumnPlace& other) const;

  [[noreturn]] void fail(const MapPlace& place, const std::string& message) const;

 private:
  struct Scope {
    std::vector<std::size_t> logs;
    std::string table;
  };
  [[nodiscard]] Scope scope(const MapPlace& place, const std::string& file,
                            const std::string& table) const;
  void collect(const Scope& where, const std::string& name, ColumnQuantity quantity, bool bare,
               std::vector<ColumnPlace>& found) const;
  [[noreturn]] void fail_to_find(const MapPlace& place, const Scope& where,
                                 const std::string& name) const;

  const ImportMap* map_;
  const std::vector<OpenedLog>* logs_;
  const std::vector<std::string>* joint_names_;
};

}  // namespace dyngen::runtime
