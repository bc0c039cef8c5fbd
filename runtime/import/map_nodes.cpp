// SPDX-License-Identifier: MIT
#include "runtime/import/map_nodes.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/import/spelling.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kMostFaults = 20;

}  // namespace

void MapFaults::add(const MapPlace& place, const std::string& message) {
  if (lines_.size() >= kMostFaults) {
    ++left_out_;
    return;
  }
  ImportMap named;
  named.name = name_;
  lines_.push_back(map_error(named, place, message));
}

void MapFaults::check() const {
  if (lines_.empty()) return;
  std::string text = fmt::format("{}", fmt::join(lines_, "\n"));
  if (left_out_ > 0) text += fmt::format("\n{}: {} more errors are left out", name_, left_out_);
  throw ImportError(text);
}

MapPlace place_of(const YAML::Node& node) {
  const YAML::Mark mark = node.Mark();
  if (mark.is_null()) return {};
  return {static_cast<std::size_t>(mark.line) + 1, static_cast<std::size_t>(mark.column) + 1};
}

MapEntries::MapEntries(const YAML::Node& node, std::string what,
                       std::initializer_list<const char*> keys, MapFaults& faults)
    : what_(std::move(what)), place_(place_of(node)), faults_(&faults) {
  const std::vector<std::string> known(keys.begin(), keys.end());
  if (!node.IsMap()) {
    faults.add(place_, fmt::format("found no keys in '{}', expected some of {}", what_,
                                   listed(known, known.size())));
    return;
  }
  for (const auto& entry : node) {
    const MapPlace place = place_of(entry.first);
    if (!entry.first.IsScalar()) {
      faults.add(place, fmt::format("found no word for a key in '{}'", what_));
      continue;
    }
    const std::string key = entry.first.Scalar();
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      const std::string near = likely_word(key, known);
      faults.add(place, fmt::format("unknown key {} in '{}'; {}", runtime::quoted(key), what_,
                                    near.empty() ? "expected " + listed(known, known.size())
                                                 : fmt::format("did you mean '{}'?", near)));
      continue;
    }
    if (has(key)) {
      faults.add(place,
                 fmt::format("found key {} a second time in '{}'", runtime::quoted(key), what_));
      continue;
    }
    entries_.emplace_back(key, entry.second);
  }
}

const YAML::Node* MapEntries::find(std::string_view key) const {
  for (const auto& [own, node] : entries_) {
    if (own == key) return &node;
  }
  return nullptr;
}

MapPlace MapEntries::place_of_value(std::string_view key) const {
  const YAML::Node* node = find(key);
  return node == nullptr ? place_ : place_of(*node);
}

std::vector<MapPlace> MapEntries::places_of_values(std::string_view key) const {
  const YAML::Node* node = find(key);
  if (node == nullptr) return {};
  if (!node->IsSequence()) return {place_of(*node)};
  std::vector<MapPlace> places;
  for (const auto& item : *node) places.push_back(place_of(item));
  return places;
}

std::vector<std::string> MapEntries::units_of_numbers(std::string_view key, MapNumber kind) const {
  const YAML::Node* node = find(key);
  if (node == nullptr) return {};
  const auto unit = [&](const YAML::Node& item) {
    return item.IsScalar() ? read_map_number(item.Scalar(), kind).unit : std::string();
  };
  if (!node->IsSequence()) return {unit(*node)};
  std::vector<std::string> units;
  for (const auto& item : *node) units.push_back(unit(item));
  return units;
}

std::optional<std::string> MapEntries::scalar(const YAML::Node& node,
                                              const std::string& what) const {
  if (node.IsScalar() && node.Scalar() == "?") {
    faults_->add(place_of(node), fmt::format("{} is a question that was not answered: expected a "
                                             "value in place of '?'",
                                             what));
    return std::nullopt;
  }
  if (node.IsScalar() && !node.Scalar().empty()) return node.Scalar();
  faults_->add(place_of(node), fmt::format("found {} in {}, expected one value",
                                           node.IsMap()        ? "keys"
                                           : node.IsSequence() ? "a list"
                                                               : "nothing",
                                           what));
  return std::nullopt;
}

std::string MapEntries::text(std::string_view key) const {
  const YAML::Node* node = find(key);
  if (node == nullptr) return {};
  return scalar(*node, fmt::format("{}: {}", what_, key)).value_or("");
}

std::vector<std::string> MapEntries::texts(std::string_view key) const {
  const YAML::Node* node = find(key);
  if (node == nullptr) return {};
  if (!node->IsSequence()) {
    const std::string one = text(key);
    return one.empty() ? std::vector<std::string>() : std::vector<std::string>{one};
  }
  std::vector<std::string> all;
  if (node->size() == 0) {
    faults_->add(place_of(*node), fmt::format("{}: found an empty list in '{}'", what_, key));
  }
  for (const auto& item : *node) {
    all.push_back(scalar(item, fmt::format("{}: {}", what_, key)).value_or(""));
  }
  return all;
}

ColumnNames MapEntries::columns(std::string_view key) const {
  return {place_of_value(key), texts(key)};
}

std::optional<double> MapEntries::number_of(const YAML::Node& node, MapNumber kind) const {
  const std::optional<std::string> word = scalar(node, what_);
  if (!word) return std::nullopt;
  const ReadNumber read = read_map_number(*word, kind);
  if (!read.value) {
    faults_->add(place_of(node), fmt::format("found {} in '{}', expected {}",
                                             runtime::quoted(*word), what_, read.expected));
  }
  return read.value;
}

std::optional<double> MapEntries::number(std::string_view key, MapNumber kind) const {
  const YAML::Node* node = find(key);
  return node == nullptr ? std::nullopt : number_of(*node, kind);
}

PerJoint MapEntries::numbers(std::string_view key, MapNumber kind) const {
  const YAML::Node* node = find(key);
  if (node == nullptr) return {};
  PerJoint all;
  if (!node->IsSequence()) {
    if (const auto value = number_of(*node, kind)) all.push_back(*value);
    return all;
  }
  if (node->size() == 0) {
    faults_->add(place_of(*node), fmt::format("{}: found an empty list in '{}'", what_, key));
  }
  // a wrong number has been told; 1 keeps the list's length
  for (const auto& item : *node) all.push_back(number_of(item, kind).value_or(1));
  return all;
}

}  // namespace dyngen::runtime
