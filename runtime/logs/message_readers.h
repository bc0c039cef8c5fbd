// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string_view>

#include "runtime/logs/message_decoder.h"
#include "runtime/logs/message_log.h"

namespace dyngen::runtime {

/// Reads a message of one topic into a sink.
class MessageReader {
 public:
  MessageReader() = default;
  MessageReader(const MessageReader&) = delete;
  MessageReader& operator=(const MessageReader&) = delete;
  virtual ~MessageReader() = default;
  /// @throws std::runtime_error, a sentence
  virtual void read(std::string_view bytes, FieldSink& sink) = 0;
};

/// What reads the messages of a topic. @throws std::runtime_error, a sentence: nothing can
std::unique_ptr<MessageReader> reader_of_topic(const MessageTopic& topic);

}  // namespace dyngen::runtime
