// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/logs/message_decoder.h"
#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// Messages of one kind: a topic or channel of a bag, the lines of a file.
struct MessageTopic {
  std::string name;
  std::string type;      ///< "sensor_msgs/msg/JointState"; empty: none
  std::string encoding;  ///< of messages: "cdr", "ros1" or "json"; others are left out, said
  std::string definition_encoding;  ///< "ros2msg" or "ros1msg"; empty: the file has no definition
  std::string definition;
};

struct LogMessage {
  std::size_t topic = 0;
  std::int64_t received = 0;  ///< when it was recorded, ns
  std::string_view bytes;     ///< valid until the next one is read
  std::uint64_t place = 0;    ///< of the message in the file, from 1
};

/// A file of messages, gone through in its order, twice.
class MessageSource {
 public:
  MessageSource() = default;
  MessageSource(const MessageSource&) = delete;
  MessageSource& operator=(const MessageSource&) = delete;
  virtual ~MessageSource() = default;

  /// More may come while messages are read.
  [[nodiscard]] virtual const std::vector<MessageTopic>& topics() const = 0;
  /// False at the end. @throws LogError
  virtual bool next(LogMessage& message) = 0;
  virtual void rewind() = 0;
  [[nodiscard]] virtual std::string place_word() const { return "message"; }
  /// Messages have the time at which they were recorded.
  [[nodiscard]] virtual bool has_received() const { return true; }
  [[nodiscard]] virtual std::vector<std::string> notices() const { return {}; }
  [[nodiscard]] virtual double fraction_read() const = 0;
};

/// Each topic is a table with a column for every number that its messages have. The source is gone
/// through once for the columns, which depend on names within messages, and once for the rows.
///
/// Columns: "received" in s from the first message of the file; points in time in s from the first
/// one of the file that is not 0; all others as MessageDecoder names them. A number that a message
/// does not have is NaN.
///
/// @throws LogError with the number of the message that cannot be read
std::unique_ptr<RawLog> open_message_log(std::unique_ptr<MessageSource> source,
                                         const std::string& name);

}  // namespace dyngen::runtime
