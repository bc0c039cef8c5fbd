// SPDX-License-Identifier: MIT
#include "runtime/logs/json_sides.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "runtime/logs/array_log.h"
#include "runtime/logs/log_error.h"

namespace dyngen::runtime {
namespace {

bool is_time_name(std::string name) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  constexpr std::array<std::string_view, 6> kNames = {"t",     "time",      "times",
                                                      "stamp", "timestamp", "timestamps"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end() || name.ends_with("_time") ||
         name.starts_with("time_");
}

/// A list of numbers, not of lists.
bool is_vector(const JsonArrayName& name, const JsonTable& table) {
  return table.columns().size() == 1 && table.columns().front().name == name.second;
}

/// The path of what an object is part of; nothing of the outermost one.
std::optional<std::string> outer_of(const std::string& path) {
  if (path.empty()) return std::nullopt;
  const std::size_t point = path.rfind('.');
  return point == path.npos ? std::string() : path.substr(0, point);
}

/// The name and the length of the time beside the arrays of an object.
struct Clock {
  std::string name;
  std::size_t length = 0;
};

std::optional<Clock> clock_beside(const JsonArrays& arrays, const std::string& path) {
  for (std::optional<std::string> object = path; object; object = outer_of(*object)) {
    std::optional<Clock> alike;
    bool differ = false;
    for (const auto& [name, table] : arrays) {
      if (name.first != *object || !is_vector(name, table)) continue;
      if (is_time_name(name.second)) return Clock{name.second, table.rows()};
      differ = differ || (alike && alike->length != table.rows());
      alike = Clock{name.second, table.rows()};
    }
    if (alike && !differ) return alike;
  }
  return std::nullopt;
}

/// Whether the lists are channels. @param rows, columns  how many lists, and numbers in each
bool are_channels(const JsonArrayName& name, std::size_t rows, std::size_t columns,
                  const std::optional<Clock>& clock, bool other_samples, const std::string& file) {
  const bool may_be_samples = clock ? rows == clock->length : rows >= columns;
  const bool may_be_channels = clock ? columns == clock->length : columns >= rows;
  constexpr std::size_t kFewestSamples = 10;  // fewer without a time are numbers of the setup
  if (!clock && std::max(rows, columns) < kFewestSamples) return false;
  if (!clock && other_samples && rows == columns) return false;
  if (may_be_samples && may_be_channels) {
    throw log_error(file,
                    fmt::format("found {} lists of {} numbers in '{}'{}: they may be samples or "
                                "channels; give each channel a list of its own name ('{}1': [...], "
                                "'{}2': [...]), or leave the last sample out of one side",
                                rows, columns, name.second,
                                clock ? fmt::format(", as many as in '{}'", clock->name)
                                      : std::string(" and no time beside them"),
                                name.second, name.second));
  }
  return may_be_channels;
}

/// Each list becomes a column.
void turn(JsonTable& table, const std::string& name) {
  std::vector<JsonColumn> lists(table.rows());
  for (std::size_t i = 0; i < lists.size(); ++i) {
    lists[i].name = name.empty() ? std::to_string(i + 1) : fmt::format("{}[{}]", name, i + 1);
  }
  const std::size_t samples = table.columns().size();
  for (std::size_t sample = 0; sample < samples; ++sample) {
    const JsonColumn& column = table.columns()[sample];
    const double origin = column.origin ? static_cast<double>(column.origin->count) /
                                              static_cast<double>(column.origin->counts_per_unit)
                                        : 0;
    for (const JsonSample& one : column.samples) {
      lists[one.row].samples.push_back({sample, one.value + origin});
    }
  }
  table.set_columns(std::move(lists), samples);
}

/// Whether nearly all lists have as many numbers; some may be missing.
bool is_matrix(const JsonTable& table) {
  constexpr double kMostThere = 0.9;
  std::size_t there = 0;
  for (const JsonColumn& column : table.columns()) there += column.samples.size();
  return static_cast<double>(there) >=
         kMostThere * static_cast<double>(table.rows() * table.columns().size());
}

}  // namespace

std::vector<std::string> turn_channels(JsonArrays& arrays, bool other_samples,
                                       const std::string& file) {
  std::vector<std::string> names;
  for (auto& [name, table] : arrays) {
    const std::size_t columns = table.columns().size();
    if (is_vector(name, table) || columns < 2) continue;
    if (is_matrix(table) && are_channels(name, table.rows(), columns,
                                         clock_beside(arrays, name.first), other_samples, file)) {
      if (table.overflowed()) {
        throw log_error(file, fmt::format("found lists of more than {} numbers in '{}', expected "
                                          "fewer: write one object a line (JSON lines), or a list "
                                          "for each sample",
                                          kMostJsonSamples, name.second));
      }
      turn(table, name.second);
      names.push_back(name.first.empty() ? name.second : name.first + "." + name.second);
    }
  }
  return names;
}

}  // namespace dyngen::runtime
