// SPDX-License-Identifier: MIT
// Columns that hold the names of the joints, as `rostopic echo -p` writes a message: field.name0 is
// the name of the joint whose position is field.position0.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "runtime/import/guess/map_guess.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

/// "field." of "field.name{i}": what the columns of one message have in common.
std::string message_of(const std::string& pattern) {
  const std::size_t mark = pattern.find('{');
  const std::size_t end = pattern.find_last_of("./", mark);
  return mark == pattern.npos || end == pattern.npos ? std::string() : pattern.substr(0, end + 1);
}

bool holds_names(const ColumnFamily& family) {
  return std::any_of(family.words.begin(), family.words.end(), [](const std::string& word) {
    return word == "name" || word == "names" || word == "joint";
  });
}

}  // namespace

void MapGuess::find_name_columns() {
  for (std::size_t t = 0; t < logs_.tables.size(); ++t) {
    const SampledTable& own = logs_.tables[t];
    if (own.words.size() != own.table.columns.size()) continue;
    for (const ColumnFamily& family : column_families(own.table.columns, {})) {
      if (family.columns.size() < 2 || !holds_names(family)) continue;
      NameColumns found{t, family.pattern, message_of(family.pattern), {}, {}};
      for (const std::size_t c : family.columns) found.names.push_back(own.words[c]);
      const auto empty = [](const std::string& word) { return word.empty(); };
      if (std::any_of(found.names.begin(), found.names.end(), empty)) continue;
      const std::vector<std::string>& wanted = robot_.joints.names;
      for (const std::string& joint : wanted) {
        const auto at = std::find(found.names.begin(), found.names.end(), joint);
        if (at == found.names.end()) break;
        found.order.push_back(static_cast<std::size_t>(at - found.names.begin()));
      }
      found.of_robot = !wanted.empty() && found.order.size() == wanted.size();
      if (!found.of_robot) {
        found.order.resize(found.names.size());
        std::iota(found.order.begin(), found.order.end(), std::size_t{0});
      }
      name_columns_.push_back(std::move(found));
    }
  }
}

void MapGuess::order_by_names(std::size_t table, ColumnFamily& family) const {
  for (const NameColumns& names : name_columns_) {
    if (names.table != table || family.columns.size() != names.names.size() ||
        message_of(family.pattern) != names.message || family.pattern == names.pattern) {
      continue;
    }
    const bool as_it_is = names.order.size() == names.names.size() &&
                          std::is_sorted(names.order.begin(), names.order.end());
    if (as_it_is) return;
    std::vector<std::size_t> columns;
    for (const std::size_t place : names.order) columns.push_back(family.columns[place]);
    family.columns = std::move(columns);
    // no pattern any more: the columns are listed
    const std::size_t mark = family.pattern.find('{');
    family.pattern.replace(mark, family.pattern.find('}', mark) - mark + 1, "*");
    return;
  }
}

void MapGuess::note_name_columns() {
  for (const NameColumns& names : name_columns_) {
    std::vector<std::string> ordered;
    for (const std::size_t place : names.order) ordered.push_back(names.names[place]);
    if (names.of_robot) {
      reason(kSure, fmt::format("joints are ordered as in the robot file by the names in {}: {}",
                                names.pattern, fmt::join(ordered, ", ")));
    } else if (robot_.joints.joints > 0) {
      remark(
          fmt::format("joints stand as in {}: {}. Not all joints of the robot file are among "
                      "them: is the order that of the robot file?",
                      names.pattern, fmt::join(ordered, ", ")));
    } else {
      remark(
          fmt::format("joints stand as in {}: {}. With --robot they are ordered as in the robot "
                      "file",
                      names.pattern, fmt::join(ordered, ", ")));
    }
  }
}

}  // namespace dyngen::runtime
