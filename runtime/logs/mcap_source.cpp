// SPDX-License-Identifier: MIT
#include "runtime/logs/mcap_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/logs/log_error.h"
#include "runtime/logs/unpacking.h"

namespace dyngen::runtime {
namespace {

constexpr std::string_view kMcapMagic = {"\x89MCAP0\r\n", 8};
constexpr std::uint64_t kMcapRecordHead = 9;  ///< a byte for the kind, eight for the length

enum McapRecord : unsigned char {
  kMcapFooter = 0x02,
  kMcapSchema = 0x03,
  kMcapChannel = 0x04,
  kMcapMessage = 0x05,
  kMcapChunk = 0x06,
  kMcapDataEnd = 0x0F,
};

struct McapSchema {
  std::string name, encoding, definition;
};

struct McapChannel {
  std::size_t topic = 0;
  std::uint16_t schema = 0;
  std::string name, encoding;
};

class McapSource final : public MessageSource {
 public:
  explicit McapSource(const LogBytes& bytes) : file_(bytes) { McapSource::rewind(); }

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
  void check_end();
  bool take_record(unsigned char kind, std::string_view content, LogMessage& message);
  void take_schema(PieceReader& piece);
  void take_channel(PieceReader& piece);
  void take_message(PieceReader& piece, LogMessage& message);
  void open_chunk(std::string_view content);

  BinaryReader file_;
  std::map<std::uint16_t, McapSchema> schemas_;
  std::map<std::uint16_t, McapChannel> channels_;
  std::vector<MessageTopic> topics_;
  std::string record_;                   ///< of the file
  std::string chunk_;                    ///< unpacked
  std::optional<PieceReader> in_chunk_;  ///< what is left of it
  std::uint64_t record_place_ = 0;       ///< of the record of the file that is read
  std::uint64_t number_ = 0;             ///< of the message
  bool at_end_ = false;
};

void McapSource::rewind() {
  file_.seek(0);
  std::string magic;
  file_.read(magic, kMcapMagic.size(), "the first bytes of MCAP");
  if (magic != kMcapMagic) file_.fail(0, "found no MCAP file of version 0");
  in_chunk_.reset();
  number_ = 0;
  at_end_ = false;
}

void McapSource::take_schema(PieceReader& piece) {
  const auto id = piece.number<std::uint16_t>();
  McapSchema schema;
  schema.name = std::string(piece.text());
  schema.encoding = std::string(piece.text());
  schema.definition = std::string(piece.text());
  schemas_[id] = std::move(schema);
}

void McapSource::take_channel(PieceReader& piece) {
  const auto id = piece.number<std::uint16_t>();
  McapChannel channel;
  channel.schema = piece.number<std::uint16_t>();
  channel.name = std::string(piece.text());
  channel.encoding = std::string(piece.text());
  const auto known = channels_.find(id);
  if (known != channels_.end()) {  // channels stand in chunks and again in the summary
    if (known->second.name != channel.name || known->second.schema != channel.schema) {
      throw std::runtime_error(
          fmt::format("found channel {} for a second time, for another topic", id));
    }
    return;
  }
  const auto schema = schemas_.find(channel.schema);
  if (channel.schema != 0 && schema == schemas_.end()) {
    throw std::runtime_error(
        fmt::format("found channel {} with schema {}, which is not there", id, channel.schema));
  }
  MessageTopic topic;
  topic.name = channel.name;
  topic.encoding = channel.encoding;
  if (channel.schema != 0) {
    topic.type = schema->second.name;
    topic.definition_encoding = schema->second.encoding;
    topic.definition = schema->second.definition;
  }
  channel.topic = topics_.size();
  topics_.push_back(std::move(topic));
  channels_[id] = std::move(channel);
}

void McapSource::take_message(PieceReader& piece, LogMessage& message) {
  const auto id = piece.number<std::uint16_t>();
  const auto channel = channels_.find(id);
  if (channel == channels_.end()) {
    throw std::runtime_error(fmt::format("found a message of channel {}, which is not there", id));
  }
  piece.number<std::uint32_t>();  // number in its sequence
  message.topic = channel->second.topic;
  message.received = static_cast<std::int64_t>(piece.number<std::uint64_t>());
  piece.number<std::uint64_t>();  // when it was published
  message.bytes = piece.bytes(piece.left());
  message.place = ++number_;
}

void McapSource::open_chunk(std::string_view content) {
  PieceReader piece(content);
  piece.number<std::uint64_t>();  // the first and the last time
  piece.number<std::uint64_t>();
  const auto size = piece.number<std::uint64_t>();
  const auto crc = piece.number<std::uint32_t>();
  const std::string method(piece.text());
  const std::string_view packed = piece.bytes(piece.number<std::uint64_t>());
  if (size > kMostUnpacked) {
    throw std::runtime_error(
        fmt::format("found a chunk of {} bytes, expected {} at most", size, kMostUnpacked));
  }
  chunk_ = unpacked(method, packed, static_cast<std::size_t>(size));
  if (chunk_.size() != size) {
    throw std::runtime_error(
        fmt::format("found a chunk of {} bytes, expected {}", chunk_.size(), size));
  }
  if (crc != 0 && crc32_of(chunk_) != crc) {
    throw std::runtime_error("found a chunk whose check (CRC) does not fit: it is damaged");
  }
  in_chunk_.emplace(chunk_);
}

/// True if the record is a message.
bool McapSource::take_record(unsigned char kind, std::string_view content, LogMessage& message) {
  PieceReader piece(content);
  switch (kind) {
    case kMcapSchema:
      take_schema(piece);
      return false;
    case kMcapChannel:
      take_channel(piece);
      return false;
    case kMcapMessage:
      take_message(piece, message);
      return true;
    default:  // indices, attachments, metadata, and what later versions add
      return false;
  }
}

/// What follows the data is not read, but it has to be there.
void McapSource::check_end() {
  std::string magic;
  file_.seek(file_.size() - std::min<std::uint64_t>(file_.size(), kMcapMagic.size()));
  file_.read(magic, kMcapMagic.size(), "the last bytes of MCAP");
  if (magic != kMcapMagic) {
    file_.fail(file_.size(), "found no end of MCAP: the file is truncated (mcap recover mends it)");
  }
}

/// One record of the file. @return false at the end
bool McapSource::next_of_file(LogMessage& message, bool& found) {
  record_place_ = file_.place();
  std::string head;
  file_.read(head, kMcapRecordHead, "a record of MCAP, or the end of the data");
  PieceReader head_piece(head);
  const unsigned char kind = head_piece.number<std::uint8_t>();
  const auto length = head_piece.number<std::uint64_t>();
  if (kind == 0) file_.fail(record_place_, "found a record of kind 0, which MCAP does not have");
  if (kind == kMcapDataEnd || kind == kMcapFooter) {
    check_end();
    return false;
  }
  const bool used =
      kind == kMcapSchema || kind == kMcapChannel || kind == kMcapMessage || kind == kMcapChunk;
  if (!used) {
    if (length > file_.left()) file_.read(record_, length, "the record that begins here");
    file_.seek(file_.place() + length);
    return true;
  }
  file_.read(record_, length, "the record that begins here");
  if (kind == kMcapChunk) {
    open_chunk(record_);
  } else {
    found = take_record(kind, record_, message);
  }
  return true;
}

bool McapSource::next(LogMessage& message) {
  try {
    while (!at_end_) {
      bool found = false;
      if (in_chunk_ && in_chunk_->left() > 0) {
        const auto kind = in_chunk_->number<std::uint8_t>();
        const std::string_view content = in_chunk_->bytes(in_chunk_->number<std::uint64_t>());
        found = take_record(kind, content, message);
      } else {
        in_chunk_.reset();
        at_end_ = !next_of_file(message, found);
      }
      if (found) return true;
    }
  } catch (const LogError&) {
    throw;
  } catch (const std::runtime_error& error) {
    file_.fail(record_place_, error.what());
  }
  return false;
}

}  // namespace

std::unique_ptr<MessageSource> open_mcap(const LogBytes& bytes) {
  return std::make_unique<McapSource>(bytes);
}

}  // namespace dyngen::runtime
