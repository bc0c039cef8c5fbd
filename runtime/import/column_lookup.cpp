// SPDX-License-Identifier: MIT
#include "runtime/import/column_lookup.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/import/signal_units.h"
#include "runtime/import/spelling.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

void replace_word(std::string& text, std::string_view word, const std::string& by) {
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + by.size())) {
    text.replace(at, word.size(), by);
  }
}

/// What a column is called besides its own name.
bool is_called(const LogTable& table, const std::string& column, const std::string& name) {
  if (table.name.empty()) return false;
  if (name == table.name + "." + column || name == table.name + "/" + column) return true;
  return table.columns.size() == 1 && name == table.name;
}

}  // namespace

std::string column_of_joint(const std::string& pattern, std::size_t joint,
                            const std::vector<std::string>& joint_names) {
  std::string name = pattern;
  replace_word(name, "{n}", std::to_string(joint + 1));
  replace_word(name, "{i}", std::to_string(joint));
  if (joint < joint_names.size()) replace_word(name, "{joint}", joint_names[joint]);
  return name;
}

bool is_column_pattern(const std::string& name) {
  return name.find("{n}") != name.npos || name.find("{i}") != name.npos ||
         name.find("{joint}") != name.npos;
}

void ColumnLookup::fail(const MapPlace& place, const std::string& message) const {
  throw ImportError(map_error(*map_, place, message));
}

ColumnLookup::Scope ColumnLookup::scope(const MapPlace& place, const std::string& file,
                                        const std::string& table) const {
  Scope where;
  where.table = table.empty() ? map_->table : table;
  bool any = where.table.empty();
  for (std::size_t i = 0; i < logs_->size(); ++i) {
    const OpenedLog& one = (*logs_)[i];
    if (!file.empty() && one.key != file) continue;
    where.logs.push_back(i);
    for (const LogTable& own : one.log->tables()) any = any || own.name == where.table;
  }
  if (!any) {
    std::vector<std::string> names;
    for (const std::size_t i : where.logs) {
      for (const LogTable& own : (*logs_)[i].log->tables()) names.push_back(own.name);
    }
    const std::string near = likely_word(where.table, names);
    fail(place, fmt::format("found no table {} in {}; {}", runtime::quoted(where.table),
                            (*logs_)[where.logs.front()].path,
                            near.empty() ? "it has " + listed(names)
                                         : fmt::format("did you mean '{}'?", near)));
  }
  return where;
}

void ColumnLookup::collect(const Scope& where, const std::string& name, ColumnQuantity quantity,
                           bool bare, std::vector<ColumnPlace>& found) const {
  const ColumnLabel asked = name_and_unit(name);
  const std::string_view bare_name =
      signal_unit(asked.unit, quantity) ? asked.name : std::string_view(name);
  for (const std::size_t i : where.logs) {
    const std::vector<LogTable>& tables = (*logs_)[i].log->tables();
    for (std::size_t t = 0; t < tables.size(); ++t) {
      const LogTable& table = tables[t];
      if (!where.table.empty() && table.name != where.table) continue;
      for (std::size_t c = 0; c < table.columns.size(); ++c) {
        const std::string& column = table.columns[c];
        const ColumnLabel parts = name_and_unit(column);
        const bool has_unit = signal_unit(parts.unit, quantity).has_value();
        // the map and the log may have the unit in the name or not
        const bool is_it = bare ? (has_unit ? parts.name : column) == bare_name
                                : column == name || is_called(table, column, name);
        if (!is_it) continue;
        ColumnPlace place{i, t, c, name, {}};
        if (c < table.units.size() && !table.units[c].empty()) {
          place.unit = table.units[c];
        } else if (has_unit) {
          place.unit = parts.unit;
        }
        found.push_back(std::move(place));
      }
    }
  }
}

void ColumnLookup::fail_to_find(const MapPlace& place, const Scope& where,
                                const std::string& name) const {
  std::vector<std::string> names;
  for (const std::size_t i : where.logs) {
    for (const LogTable& table : (*logs_)[i].log->tables()) {
      if (!where.table.empty() && table.name != where.table) continue;
      names.insert(names.end(), table.columns.begin(), table.columns.end());
    }
  }
  const std::string near = likely_word(name, names);
  fail(place,
       fmt::format("found no column {} in {}{}; {}{}", runtime::quoted(name),
                   (*logs_)[where.logs.front()].path,
                   where.table.empty() ? "" : ", table " + runtime::quoted(where.table),
                   near.empty() ? "" : fmt::format("did you mean {}? ", runtime::quoted(near)),
                   "it has " + listed(names)));
}

std::optional<ColumnPlace> ColumnLookup::find(const MapPlace& place, const std::string& file,
                                              const std::string& table, const std::string& name,
                                              ColumnQuantity quantity, bool required) const {
  const Scope where = scope(place, file, table);
  std::vector<ColumnPlace> found;
  collect(where, name, quantity, false, found);
  if (found.empty()) collect(where, name, quantity, true, found);
  if (found.empty() && !required) return std::nullopt;
  if (found.empty()) fail_to_find(place, where, name);
  if (found.size() > 1) {
    std::vector<std::string> tables;
    for (const ColumnPlace& one : found) {
      const OpenedLog& log = (*logs_)[one.log];
      const std::string& own = log.log->tables()[one.table].name;
      tables.push_back(own.empty() ? log.path : own);
    }
    const bool within = std::all_of(found.begin(), found.end(), [&](const ColumnPlace& one) {
      return one.same_table(found.front());
    });
    fail(place, within ? fmt::format("found column {} {} times in {}, expected it once",
                                     runtime::quoted(name), found.size(), listed({tables.front()}))
                       : fmt::format("found column {} in several tables: {}; expected 'table' (or "
                                     "'file') to say which",
                                     runtime::quoted(name), listed(tables)));
  }
  return found.front();
}

std::vector<ColumnPlace> ColumnLookup::find_all(const ColumnNames& columns, const std::string& file,
                                                const std::string& table, std::size_t joints,
                                                ColumnQuantity quantity) const {
  std::vector<ColumnPlace> found;
  const bool pattern = columns.names.size() == 1 && is_column_pattern(columns.names.front());
  if (!pattern) {
    if (joints != 0 && columns.names.size() != joints) {
      fail(columns.place,
           fmt::format("found {} column{} for {} joints, expected a list of {}, or a name with "
                       "{{n}} in it for the joint's number ({{i}} from 0, {{joint}} its name)",
                       columns.names.size(), columns.names.size() == 1 ? "" : "s", joints, joints));
    }
    for (const std::string& name : columns.names) {
      found.push_back(*find(columns.place, file, table, name, quantity, true));
    }
    return found;
  }
  const std::string& word = columns.names.front();
  if (word.find("{joint}") != word.npos && joint_names_->empty()) {
    fail(columns.place,
         "found {joint} in a name, and the joints have no names: expected 'joints' to be a list of "
         "them, or a robot file that names them");
  }
  const std::size_t most =
      joints != 0 ? joints
                  : (word.find("{joint}") != word.npos ? joint_names_->size() : std::size_t{1000});
  for (std::size_t j = 0; j < most; ++j) {
    // without a number of joints, the first that is missing ends them
    const bool required = joints != 0 || j == 0;
    auto one = find(columns.place, file, table, column_of_joint(word, j, *joint_names_), quantity,
                    required);
    if (!one) break;
    found.push_back(std::move(*one));
  }
  return found;
}

std::optional<ColumnPlace> ColumnLookup::clock_of(const ColumnPlace& other) const {
  const LogTable& table = (*logs_)[other.log].log->tables()[other.table];
  const std::string& name = map_->time.column;
  const ColumnLabel asked = name_and_unit(name);
  const std::string_view bare_name =
      unit_conversion(asked.unit, ColumnQuantity::kTime) ? asked.name : std::string_view(name);
  const auto make = [&](std::size_t c, std::string unit) {
    return ColumnPlace{other.log, other.table, c, name, std::move(unit)};
  };
  for (const bool bare : {false, true}) {
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const ColumnLabel parts = name_and_unit(table.columns[c]);
      const bool has_unit = unit_conversion(parts.unit, ColumnQuantity::kTime).has_value();
      if (bare ? (has_unit ? parts.name : std::string_view(table.columns[c])) != bare_name
               : table.columns[c] != name && !is_called(table, table.columns[c], name)) {
        continue;
      }
      const bool told = c < table.units.size() && !table.units[c].empty();
      return make(c, told ? table.units[c] : has_unit ? std::string(parts.unit) : std::string());
    }
  }
  return std::nullopt;
}

}  // namespace dyngen::runtime
