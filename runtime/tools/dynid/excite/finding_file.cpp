// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/finding_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include "runtime/tools/dynid/robot/json_numbers.h"

namespace dyngen::runtime {
namespace {

constexpr const char* kSchema = "dynid.diagnosis/1";

/// A place in the file with a name for messages.
struct Node {
  const std::string& path;
  std::string name;
  const Json& json;

  [[noreturn]] void refuse(const std::string& expected) const {
    constexpr std::size_t kMost = 60;
    std::string found = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (found.size() > kMost) found = found.substr(0, kMost) + "...";
    throw std::invalid_argument(
        fmt::format("{}: {}: found {}, expected {}", path, name, found, expected));
  }

  [[nodiscard]] Node at(const std::string& key) const {
    if (!json.is_object()) refuse("an object");
    const std::string own = name == "the file" ? key : name + "." + key;
    const auto found = json.find(key);
    if (found == json.end()) {
      throw std::invalid_argument(
          fmt::format("{}: {}: found nothing, expected the key of schema {}", path, own, kSchema));
    }
    return {path, own, *found};
  }
  [[nodiscard]] std::vector<Node> items() const {
    if (!json.is_array()) refuse("an array");
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < json.size(); ++i) {
      nodes.push_back({path, fmt::format("{}[{}]", name, i), json[i]});
    }
    return nodes;
  }
  [[nodiscard]] std::string text() const {
    if (!json.is_string()) refuse("text");
    return json.get<std::string>();
  }
  [[nodiscard]] std::string text_or_nothing() const {
    return json.is_null() ? std::string() : text();
  }
  [[nodiscard]] int count(int least) const {
    const std::string expected = fmt::format("a whole number from {} on", least);
    if (!json.is_number_integer()) refuse(expected);
    const auto value = json.get<std::int64_t>();
    if (value < least || value > std::numeric_limits<int>::max()) refuse(expected);
    return static_cast<int>(value);
  }
  /// NaN for null.
  [[nodiscard]] double number() const {
    if (json.is_null()) return std::numeric_limits<double>::quiet_NaN();
    if (!json.is_number()) refuse("a number or null");
    return json.get<double>();
  }
};

Json parsed(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw std::invalid_argument(
        fmt::format("{}: it cannot be opened: {}; expected the JSON of dynid diagnose", path,
                    std::strerror(errno)));
  }
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  try {
    return Json::parse(text);
  } catch (const Json::parse_error& error) {
    const auto end = std::min(error.byte, text.size());
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(end), '\n');
    throw std::invalid_argument(fmt::format(
        "{}:{}: found text that is not JSON, expected what dynid diagnose --json writes", path,
        line));
  }
}

OpenFinding finding_of(const Node& node) {
  OpenFinding finding;
  finding.family = node.at("family").text();
  finding.joint = node.at("joint").count(0);
  const Node other = node.at("other_joint");
  finding.other = other.json.is_null() ? 0 : other.count(1);
  for (const Node& alias : node.at("aliases").items()) finding.aliases.push_back(alias.text());
  finding.formula = node.at("formula").text_or_nothing();
  const Node parameters = node.at("parameters");
  if (!parameters.json.is_object()) parameters.refuse("an object");
  for (const auto& [name, value] : parameters.json.items()) {
    finding.parameters[name] = parameters.at(name).at("value").number();
  }
  return finding;
}

}  // namespace

OpenFinding read_open_finding(const std::string& path) {
  const Json json = parsed(path);
  const Node file{path, "the file", json};
  const Node schema = file.at("schema");
  if (schema.text() != kSchema) schema.refuse(fmt::format("\"{}\"", kSchema));
  const std::vector<Node> findings = file.at("findings").items();
  const auto open = std::find_if(findings.begin(), findings.end(), [](const Node& node) {
    // motions separate effects of one state of the robot, not states
    const auto since = node.json.find("since_reference");
    const bool change = since != node.json.end() && since->is_boolean() && since->get<bool>();
    return node.at("aliases").items().size() > 1 && !change;
  });
  if (open == findings.end()) {
    throw std::invalid_argument(fmt::format(
        "{}: {}: nothing is left to separate; expected a finding with several aliases", path,
        findings.empty() ? "it has no findings"
                         : fmt::format("each of its {} findings has one name", findings.size())));
  }
  OpenFinding finding = finding_of(*open);
  finding.number = static_cast<int>(open - findings.begin()) + 1;
  finding.robot = file.at("robot").text();
  finding.joints = file.at("joints").count(1);
  for (const Node& node : file.at("base_parameters").items()) {
    finding.base_parameters[node.at("name").text()] = node.at("after").number();
  }
  for (const Node& node : file.at("heldout").at("noise_floor").items()) {
    finding.noise_floor.push_back(node.number());
  }
  return finding;
}

}  // namespace dyngen::runtime
