// SPDX-License-Identifier: MIT
#include "runtime/logs/message_definition.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <stdexcept>

#include "runtime/logs/log_error.h"
#include "runtime/recordings/columns.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kMostTypes = 500, kDeepestType = 32;
constexpr std::size_t kMostFixedElements = 1 << 20;
constexpr std::size_t kMostBytes = 1 << 30;  ///< of a message

struct PlainType {
  std::string_view name;
  FieldType type;
};

constexpr std::array<PlainType, 13> kPlainTypes = {{{"bool", FieldType::kBool},
                                                    {"int8", FieldType::kInt8},
                                                    {"uint8", FieldType::kUint8},
                                                    {"int16", FieldType::kInt16},
                                                    {"uint16", FieldType::kUint16},
                                                    {"int32", FieldType::kInt32},
                                                    {"uint32", FieldType::kUint32},
                                                    {"int64", FieldType::kInt64},
                                                    {"uint64", FieldType::kUint64},
                                                    {"float32", FieldType::kFloat32},
                                                    {"float64", FieldType::kFloat64},
                                                    {"string", FieldType::kString},
                                                    {"char", FieldType::kUint8}}};

std::size_t least_bytes_of(FieldType type) {
  switch (type) {
    case FieldType::kBool:
    case FieldType::kInt8:
    case FieldType::kUint8:
    case FieldType::kMessage:
      return 1;
    case FieldType::kInt16:
    case FieldType::kUint16:
      return 2;
    case FieldType::kInt32:
    case FieldType::kUint32:
    case FieldType::kFloat32:
    case FieldType::kString:
      return 4;
    case FieldType::kInt64:
    case FieldType::kUint64:
    case FieldType::kFloat64:
    case FieldType::kTime:
    case FieldType::kDuration:
      return 8;
  }
  return 1;
}

/// Calls `use` with each line of a text, without its comment and blanks.
template <typename Use>
void for_each_line(std::string_view text, const Use& use) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line = line.substr(0, line.find('#'));
    while (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    line = trimmed(line);
    if (!line.empty()) use(line);
  }
}

class DefinitionReader {
 public:
  DefinitionReader(std::string_view text, std::string_view name, RosVersion version)
      : version_(version) {
    split(text, plain_type_name(name));
    add_type(plain_type_name(name), 0);
  }
  MessageDefinition take() { return std::move(definition_); }

 private:
  void split(std::string_view text, const std::string& name);
  std::size_t add_type(const std::string& name, std::size_t depth);
  void read_field(std::string_view line, MessageType& type, std::size_t depth);
  void read_array(std::string_view& word, MessageField& field, std::string_view line) const;
  std::string resolve(std::string_view word, const std::string& parent) const;

  RosVersion version_;
  std::map<std::string, std::string> texts_;
  std::map<std::string, std::size_t> places_;
  std::vector<std::string> open_;  ///< types that are being read
  MessageDefinition definition_;
};

/// Cuts "... ==== MSG: package/Type ..." into the texts of the types.
void DefinitionReader::split(std::string_view text, const std::string& name) {
  std::string current = name;
  for_each_line(text, [&](std::string_view line) {
    if (line.find_first_not_of('=') == line.npos) return;
    if (line.starts_with("MSG:")) {
      current = plain_type_name(trimmed(line.substr(4)));
      texts_[current];
      return;
    }
    texts_[current].append(line).append("\n");
  });
  texts_[name];
}

std::size_t DefinitionReader::add_type(const std::string& name, std::size_t depth) {
  if (const auto known = places_.find(name); known != places_.end()) return known->second;
  if (std::find(open_.begin(), open_.end(), name) != open_.end()) {
    throw std::runtime_error(fmt::format("type {} contains itself", in_quotes(name)));
  }
  if (depth > kDeepestType || definition_.types.size() >= kMostTypes) {
    throw std::runtime_error("types are nested too deeply");
  }
  const auto given = texts_.find(name);
  std::string text;
  if (given != texts_.end()) {
    text = given->second;
  } else {
    const std::vector<std::string> known = known_definitions(name);
    if (known.empty()) {
      throw std::runtime_error(fmt::format(
          "type {} is unknown, and the file does not say what it is made of", in_quotes(name)));
    }
    text = known.front();
  }
  open_.push_back(name);
  const std::size_t place = definition_.types.size();
  definition_.types.emplace_back();
  MessageType type;
  type.name = name;
  for_each_line(text, [&](std::string_view line) { read_field(line, type, depth); });
  // ROS 2 puts a byte into messages without fields.
  if (type.fields.empty() && version_ == RosVersion::kTwo) {
    type.fields.push_back({"structure_needs_at_least_one_member", FieldType::kUint8});
  }
  std::size_t least = 0;
  for (const MessageField& field : type.fields) {
    const std::size_t one = field.type == FieldType::kMessage
                                ? definition_.types[field.message].least_bytes
                                : least_bytes_of(field.type);
    least += field.array == ArrayKind::kSequence ? 4
             : field.array == ArrayKind::kFixed  ? field.size * one
                                                 : one;
    if (least > kMostBytes) throw std::runtime_error("its arrays are larger than any message");
  }
  type.least_bytes = std::max<std::size_t>(least, 1);
  definition_.types[place] = std::move(type);
  places_[name] = place;
  open_.pop_back();
  return place;
}

/// Takes "[]", "[3]" or "[<=3]" off a type.
void DefinitionReader::read_array(std::string_view& word, MessageField& field,
                                  std::string_view line) const {
  if (word.back() != ']') return;
  const std::size_t open = word.find('[');
  if (open == word.npos) {
    throw std::runtime_error(fmt::format("{} is no field of a message", in_quotes(line)));
  }
  const std::string_view inside = word.substr(open + 1, word.size() - open - 2);
  word = word.substr(0, open);
  field.array = ArrayKind::kSequence;
  if (inside.empty() || inside.starts_with("<=")) return;
  field.array = ArrayKind::kFixed;
  const auto [stop, error] =
      std::from_chars(inside.data(), inside.data() + inside.size(), field.size);
  if (error != std::errc() || stop != inside.data() + inside.size() || field.size == 0 ||
      field.size > kMostFixedElements) {
    throw std::runtime_error(fmt::format("{} has no size of an array", in_quotes(line)));
  }
}

std::string DefinitionReader::resolve(std::string_view word, const std::string& parent) const {
  if (word.find('/') != word.npos) return plain_type_name(word);
  if (word == "Header") return "std_msgs/Header";
  return parent.substr(0, parent.find('/') + 1) + std::string(word);
}

void DefinitionReader::read_field(std::string_view line, MessageType& type, std::size_t depth) {
  const std::size_t blank = line.find_first_of(" \t");
  const std::string_view rest =
      blank == line.npos ? std::string_view() : trimmed(line.substr(blank));
  std::string_view name = rest.substr(0, rest.find_first_of(" \t="));
  const std::string_view after = trimmed(rest.substr(name.size()));
  if (after.starts_with('=')) return;  // a constant
  if (name.empty()) {
    throw std::runtime_error(fmt::format("{} is no field of a message", in_quotes(line)));
  }
  MessageField field;
  field.name = std::string(name);
  std::string_view word = line.substr(0, blank);
  read_array(word, field, line);
  if (const std::size_t bound = word.find("<="); bound != word.npos) word = word.substr(0, bound);
  const auto plain = std::find_if(kPlainTypes.begin(), kPlainTypes.end(),
                                  [&](const PlainType& known) { return known.name == word; });
  if (plain != kPlainTypes.end()) {
    field.type = plain->type;
  } else if (word == "byte") {
    field.type = version_ == RosVersion::kOne ? FieldType::kInt8 : FieldType::kUint8;
  } else if (word == "time" || word == "builtin_interfaces/Time" ||
             word == "builtin_interfaces/msg/Time") {
    field.type = FieldType::kTime;
  } else if (word == "duration" || word == "builtin_interfaces/Duration" ||
             word == "builtin_interfaces/msg/Duration") {
    field.type = FieldType::kDuration;
  } else if (word == "wstring") {
    throw std::runtime_error("text of wide characters (wstring) is not read");
  } else {
    field.type = FieldType::kMessage;
    field.message = add_type(resolve(word, type.name), depth + 1);
    if (definition_.types[field.message].fields.empty()) return;  // takes no bytes in ROS 1
  }
  type.fields.push_back(std::move(field));
}

}  // namespace

std::string plain_type_name(std::string_view name) {
  std::string plain(name);
  if (const std::size_t at = plain.find("/msg/"); at != plain.npos) plain.erase(at, 4);
  return plain;
}

MessageDefinition read_definition(std::string_view text, std::string_view name,
                                  RosVersion version) {
  return DefinitionReader(text, name, version).take();
}

}  // namespace dyngen::runtime
