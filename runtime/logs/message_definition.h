// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dyngen::runtime {

enum class FieldType {
  kBool,
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kInt64,
  kUint64,
  kFloat32,
  kFloat64,
  kString,
  kTime,      ///< two words of 32 bits: s, ns
  kDuration,  ///< the same, a difference
  kMessage,
};

enum class ArrayKind { kNone, kFixed, kSequence };

struct MessageField {
  std::string name;
  FieldType type = FieldType::kFloat64;
  ArrayKind array = ArrayKind::kNone;
  std::size_t size = 0;     ///< of a fixed array
  std::size_t message = 0;  ///< index in MessageDefinition::types, of kMessage
};

struct MessageType {
  std::string name;  ///< "sensor_msgs/JointState"
  std::vector<MessageField> fields;
  std::size_t least_bytes = 1;  ///< that a value of it takes, at least 1
};

/// A message type and all that it is made of. No type contains itself.
struct MessageDefinition {
  std::vector<MessageType> types;  ///< the first is the message
};

enum class RosVersion { kOne, kTwo };

/// Reads a definition as bags hold it: the fields of the message, then those of other types after
/// lines "====" and "MSG: package/Type". Types that it leaves out are taken from those that are
/// known here.
///
/// @param name  "sensor_msgs/msg/JointState" or "sensor_msgs/JointState"
/// @throws std::runtime_error, a sentence: a type is unknown, contains itself, or a line is no
/// field
MessageDefinition read_definition(std::string_view text, std::string_view name, RosVersion version);

/// The definitions of a type that are known without the file's help, one for each version of it;
/// empty: none. docs/reference/logs.md names them.
std::vector<std::string> known_definitions(std::string_view name);

/// Without "/msg/": "sensor_msgs/JointState".
std::string plain_type_name(std::string_view name);

}  // namespace dyngen::runtime
