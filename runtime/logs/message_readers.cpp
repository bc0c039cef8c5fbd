// SPDX-License-Identifier: MIT
#include "runtime/logs/message_readers.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/logs/json_values.h"
#include "runtime/logs/log_error.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

/// Of ROS 1 and ROS 2. A type that is known in several versions is read as the first one that fits
/// its first message.
class RosReader final : public MessageReader {
 public:
  RosReader(std::vector<MessageDefinition> definitions, MessageEncoding encoding) {
    for (MessageDefinition& definition : definitions) {
      decoders_.emplace_back(std::move(definition), encoding);
    }
  }

  void read(std::string_view bytes, FieldSink& sink) override {
    if (decoders_.size() > 1) choose(bytes);
    decoders_.front().decode(bytes, sink);
  }

 private:
  class Nowhere final : public FieldSink {
    void number(std::string_view, double) override {}
    void whole(std::string_view, std::int64_t) override {}
    void instant(std::string_view, std::int64_t) override {}
    void left_out(std::string_view, std::string_view) override {}
  };

  void choose(std::string_view bytes) {
    Nowhere nowhere;
    for (MessageDecoder& decoder : decoders_) {
      try {
        decoder.decode(bytes, nowhere);
      } catch (const std::runtime_error&) {
        continue;
      }
      std::swap(decoders_.front(), decoder);
      break;
    }
    decoders_.erase(decoders_.begin() + 1, decoders_.end());
  }

  std::vector<MessageDecoder> decoders_;
};

}  // namespace

std::unique_ptr<MessageReader> reader_of_topic(const MessageTopic& topic) {
  if (topic.encoding == "json") return json_message_reader();
  const bool ros1 = topic.encoding == "ros1";
  if (!ros1 && topic.encoding != "cdr") {
    throw std::runtime_error(fmt::format(
        "messages encoded as {} are not read (cdr, ros1 and json are)", in_quotes(topic.encoding)));
  }
  const RosVersion version = ros1 ? RosVersion::kOne : RosVersion::kTwo;
  const bool given =
      topic.definition_encoding == "ros2msg" || topic.definition_encoding == "ros1msg";
  std::vector<std::string> texts;
  if (given) {
    texts.push_back(topic.definition);
  } else {
    texts = known_definitions(topic.type);
  }
  if (texts.empty()) {
    throw std::runtime_error(fmt::format(
        "its type {} is not known, and the file does not say what it is made of{}",
        in_quotes(topic.type),
        topic.definition_encoding.empty()
            ? std::string()
            : fmt::format(" in a way that is read ({})", in_quotes(topic.definition_encoding))));
  }
  std::vector<MessageDefinition> definitions;
  for (const std::string& text : texts) {
    definitions.push_back(read_definition(text, topic.type, version));
  }
  return std::make_unique<RosReader>(std::move(definitions),
                                     ros1 ? MessageEncoding::kRos1 : MessageEncoding::kCdr);
}

}  // namespace dyngen::runtime
