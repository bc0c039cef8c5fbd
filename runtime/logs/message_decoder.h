// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/logs/message_definition.h"

namespace dyngen::runtime {

/// Takes the fields of a message in the order in which they stand in it. A path is as columns are
/// named: "position[shoulder]", "wrench.force.x", "data[1]".
class FieldSink {
 public:
  FieldSink() = default;
  FieldSink(const FieldSink&) = delete;
  FieldSink& operator=(const FieldSink&) = delete;
  virtual ~FieldSink() = default;

  virtual void number(std::string_view path, double value) = 0;
  /// A whole number of up to 64 bits.
  virtual void whole(std::string_view path, std::int64_t value) = 0;
  /// A point in time, in ns since 1970 (or since what the clock counts from).
  virtual void instant(std::string_view path, std::int64_t nanoseconds) = 0;
  /// What is no number; `what` says why, for instance "text".
  virtual void left_out(std::string_view path, std::string_view what) = 0;
};

/// How the bytes of a message are laid out.
enum class MessageEncoding {
  kCdr,   ///< of ROS 2 (OMG DDSI-RTPS 2.3, 10.2; DDS-XTypes 1.3, 7.4): 4 bytes that say how, then
          ///< values at multiples of their size
  kRos1,  ///< packed, little-endian
};

/// Arrays with more elements than this are left out: they are pictures, scans, clouds.
inline constexpr std::size_t kMostArrayElements = 256;

/// Reads messages of one type.
///
/// Numbers of an array that is as long as the names of its message ("name", "joint_names",
/// "interface_names") get those as index; others are numbered from 1. The header of a message is
/// "stamp", and "seq" in ROS 1.
class MessageDecoder {
 public:
  MessageDecoder(MessageDefinition definition, MessageEncoding encoding)
      : definition_(std::move(definition)), encoding_(encoding) {}

  /// @throws std::runtime_error, a sentence with the byte (from 1) and the field: the message is
  /// too short or too long, or an array says that it is
  void decode(std::string_view bytes, FieldSink& sink) const;

 private:
  MessageDefinition definition_;
  MessageEncoding encoding_;
};

}  // namespace dyngen::runtime
