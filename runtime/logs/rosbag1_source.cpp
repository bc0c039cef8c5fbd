// SPDX-License-Identifier: MIT
#include "runtime/logs/rosbag1_source.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/logs/log_error.h"
#include "runtime/logs/time_words.h"
#include "runtime/logs/unpacking.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

constexpr std::string_view kBagVersion2 = "#ROSBAG V2.0\n";
constexpr std::uint64_t kMostBagHeader = 1 << 20;  ///< bytes; a bag's own are below 4096

enum BagRecord : unsigned char { kBagMessage = 0x02, kBagChunk = 0x05, kBagConnection = 0x07 };

/// "name=value" of a header.
using BagFields = std::map<std::string, std::string_view, std::less<>>;

BagFields bag_fields(std::string_view header) {
  BagFields fields;
  PieceReader piece(header);
  while (piece.left() > 0) {
    const std::string_view field = piece.text();
    const std::size_t sign = field.find('=');
    if (sign == field.npos) {
      throw std::runtime_error(
          fmt::format("found {}, expected a field name=value", in_quotes(field)));
    }
    fields[std::string(field.substr(0, sign))] = field.substr(sign + 1);
  }
  return fields;
}

std::string_view bag_field(const BagFields& fields, std::string_view name) {
  const auto found = fields.find(name);
  if (found == fields.end()) {
    throw std::runtime_error(
        fmt::format("found a header without {}, expected it", in_quotes(name)));
  }
  return found->second;
}

template <typename Value>
Value bag_number(const BagFields& fields, std::string_view name) {
  return PieceReader(bag_field(fields, name)).number<Value>();
}

class Rosbag1Source final : public MessageSource {
 public:
  explicit Rosbag1Source(const LogBytes& bytes) : file_(bytes) { Rosbag1Source::rewind(); }

  [[nodiscard]] const std::vector<MessageTopic>& topics() const override { return topics_; }
  [[nodiscard]] double fraction_read() const override {
    return file_.size() == 0
               ? 1
               : static_cast<double>(file_.place()) / static_cast<double>(file_.size());
  }
  void rewind() override;
  bool next(LogMessage& message) override;

 private:
  bool next_of_file(LogMessage& message, bool& found);
  bool take_record(std::string_view header, std::string_view data, LogMessage& message);
  void take_connection(const BagFields& fields, std::string_view data);
  void take_message(const BagFields& fields, std::string_view data, LogMessage& message);
  void open_chunk(const BagFields& fields, std::string_view data);

  BinaryReader file_;
  std::map<std::uint32_t, std::size_t> topic_of_connection_;
  std::map<std::pair<std::string, std::string>, std::size_t> known_;  ///< topic, definition
  std::vector<MessageTopic> topics_;
  std::string header_, data_, chunk_;
  std::optional<PieceReader> in_chunk_;
  std::uint64_t record_place_ = 0, number_ = 0;
};

void Rosbag1Source::rewind() {
  file_.seek(0);
  std::string begin;
  file_.read(begin, kBagVersion2.size(), "the first line of a bag");
  if (begin != kBagVersion2) {
    file_.fail(0, fmt::format("found {}, expected {}; rosbag migrates older bags (rosbag fix)",
                              in_quotes(begin), in_quotes(kBagVersion2.substr(0, 12))));
  }
  in_chunk_.reset();
  number_ = 0;
}

/// Several connections may publish on one topic.
void Rosbag1Source::take_connection(const BagFields& fields, std::string_view data) {
  const auto id = bag_number<std::uint32_t>(fields, "conn");
  const BagFields description = bag_fields(data);
  MessageTopic topic;
  topic.name = std::string(bag_field(fields, "topic"));
  topic.type = std::string(bag_field(description, "type"));
  topic.encoding = "ros1";
  topic.definition_encoding = "ros1msg";
  topic.definition = std::string(bag_field(description, "message_definition"));
  const auto [known, is_new] =
      known_.try_emplace({topic.name, topic.type + "\n" + topic.definition}, topics_.size());
  if (is_new) topics_.push_back(std::move(topic));
  const auto [place, is_new_id] = topic_of_connection_.try_emplace(id, known->second);
  if (!is_new_id && place->second != known->second) {
    throw std::runtime_error(
        fmt::format("found connection {} for a second time, of another topic", id));
  }
}

void Rosbag1Source::take_message(const BagFields& fields, std::string_view data,
                                 LogMessage& message) {
  const auto id = bag_number<std::uint32_t>(fields, "conn");
  const auto topic = topic_of_connection_.find(id);
  if (topic == topic_of_connection_.end()) {
    throw std::runtime_error(
        fmt::format("found a message of connection {}, which is not there", id));
  }
  PieceReader time(bag_field(fields, "time"));
  const std::int64_t seconds = time.number<std::uint32_t>();
  const std::int64_t rest = time.number<std::uint32_t>();
  message.topic = topic->second;
  message.received = seconds * kNanosecondsPerSecond + rest;
  message.bytes = data;
  message.place = ++number_;
}

void Rosbag1Source::open_chunk(const BagFields& fields, std::string_view data) {
  const auto size = bag_number<std::uint32_t>(fields, "size");
  if (size > kMostUnpacked) {
    throw std::runtime_error(
        fmt::format("found a chunk of {} bytes, expected {} at most", size, kMostUnpacked));
  }
  chunk_ = unpacked(bag_field(fields, "compression"), data, size);
  if (chunk_.size() != size) {
    throw std::runtime_error(
        fmt::format("found a chunk of {} bytes, expected {}", chunk_.size(), size));
  }
  in_chunk_.emplace(chunk_);
}

/// True if the record is a message.
bool Rosbag1Source::take_record(std::string_view header, std::string_view data,
                                LogMessage& message) {
  const BagFields fields = bag_fields(header);
  switch (bag_number<std::uint8_t>(fields, "op")) {
    case kBagConnection:
      take_connection(fields, data);
      return false;
    case kBagMessage:
      take_message(fields, data, message);
      return true;
    case kBagChunk:
      if (in_chunk_) throw std::runtime_error("found a chunk within a chunk");
      open_chunk(fields, data);
      return false;
    default:  // the bag's header, indices
      return false;
  }
}

bool Rosbag1Source::next_of_file(LogMessage& message, bool& found) {
  if (file_.left() == 0) return false;
  record_place_ = file_.place();
  std::string size;
  const auto read_part = [&](std::string& part, std::string_view what, std::uint64_t most) {
    file_.read(size, sizeof(std::uint32_t), what);
    const auto count = PieceReader(size).number<std::uint32_t>();
    if (count > most) {
      file_.fail(record_place_,
                 fmt::format("found {} bytes for {}, expected {} at most", count, what, most));
    }
    file_.read(part, count, what);
  };
  read_part(header_, "the header of a record", kMostBagHeader);
  read_part(data_, "the data of a record", kMostUnpacked);
  found = take_record(header_, data_, message);
  return true;
}

bool Rosbag1Source::next(LogMessage& message) {
  try {
    for (;;) {
      bool found = false;
      if (in_chunk_ && in_chunk_->left() > 0) {
        const std::string_view header = in_chunk_->text();
        const std::string_view data = in_chunk_->text();
        found = take_record(header, data, message);
      } else {
        in_chunk_.reset();
        if (!next_of_file(message, found)) return false;
      }
      if (found) return true;
    }
  } catch (const LogError&) {
    throw;
  } catch (const std::runtime_error& error) {
    file_.fail(record_place_, error.what());
  }
}

}  // namespace

std::unique_ptr<MessageSource> open_rosbag1(const LogBytes& bytes) {
  return std::make_unique<Rosbag1Source>(bytes);
}

}  // namespace dyngen::runtime
