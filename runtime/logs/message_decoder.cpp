// SPDX-License-Identifier: MIT
#include "runtime/logs/message_decoder.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <set>
#include <stdexcept>

#include "runtime/logs/log_error.h"
#include "runtime/logs/time_words.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

static_assert(std::endian::native == std::endian::little, "values are copied as they stand");

bool names_others(const MessageField& field) {
  if (field.type != FieldType::kString || field.array == ArrayKind::kNone) return false;
  constexpr std::array<std::string_view, 4> kNames = {"name", "names", "joint_names",
                                                      "interface_names"};
  return std::find(kNames.begin(), kNames.end(), field.name) != kNames.end();
}

/// Names that may stand for places: none is empty or comes twice.
bool may_be_keys(const std::vector<std::string_view>& names) {
  std::set<std::string_view> seen;
  return std::all_of(names.begin(), names.end(), [&](std::string_view name) {
    return !name.empty() && seen.insert(name).second;
  });
}

/// One message that is read.
class Decoding {
 public:
  Decoding(const MessageDefinition& definition, MessageEncoding encoding, std::string_view bytes,
           FieldSink& sink)
      : definition_(&definition), bytes_(bytes), sink_(&sink) {
    if (encoding == MessageEncoding::kCdr) read_encapsulation();
  }

  void run() {
    read_message(definition_->types.front(), {});
    constexpr std::size_t kPadding = 3;  // to a multiple of 4
    if (bytes_.size() - at_ > kPadding) {
      fail(fmt::format("found {} bytes after its last field, expected none", bytes_.size() - at_));
    }
  }

 private:
  using Keys = std::vector<std::string_view>;

  [[noreturn]] void fail(const std::string& message) const {
    const std::string field =
        path_.empty() ? std::string() : fmt::format(" in {}", in_quotes(path_));
    throw std::runtime_error(fmt::format("byte {}{}: {}", at_ + 1, field, message));
  }

  void read_encapsulation() {
    constexpr std::size_t kSize = 4;
    if (bytes_.size() < kSize) fail("found fewer than 4 bytes, expected a message in CDR");
    const unsigned high = static_cast<unsigned char>(bytes_[0]);
    const unsigned low = static_cast<unsigned char>(bytes_[1]);
    const unsigned kind = high << 8 | low;
    constexpr unsigned kCdr1 = 1, kCdr2 = 7;  // even ones beside them are big-endian
    if ((kind | 1U) != kCdr1 && (kind | 1U) != kCdr2) {
      fail(fmt::format("found encapsulation {:#06x}, expected plain CDR (0, 1, 6 or 7)", kind));
    }
    swaps_ = (kind & 1U) == 0;
    most_alignment_ = (kind | 1U) == kCdr2 ? 4 : 8;
    at_ = begin_ = kSize;
  }

  void need(std::size_t size) {
    if (size > bytes_.size() - at_) {
      fail(fmt::format("found the end of the message, expected {} more bytes", size));
    }
  }

  template <typename Value>
  Value read() {
    if (most_alignment_ > 0) {
      const std::size_t alignment = std::min(sizeof(Value), most_alignment_);
      const std::size_t step = (alignment - (at_ - begin_) % alignment) % alignment;
      need(step);
      at_ += step;
    }
    need(sizeof(Value));
    std::array<char, sizeof(Value)> raw;
    std::memcpy(raw.data(), bytes_.data() + at_, sizeof(Value));
    at_ += sizeof(Value);
    if (swaps_) std::reverse(raw.begin(), raw.end());
    return std::bit_cast<Value>(raw);
  }

  std::string_view read_text() {
    const auto size = read<std::uint32_t>();
    need(size);
    std::string_view text = bytes_.substr(at_, size);
    at_ += size;
    if (most_alignment_ > 0 && !text.empty() && text.back() == '\0') text.remove_suffix(1);
    return text;
  }

  /// Elements of an array that may follow: no more than the bytes that are left hold.
  std::size_t read_count(const MessageField& field, std::size_t least) {
    const std::size_t count = field.array == ArrayKind::kFixed ? field.size : read<std::uint32_t>();
    if (count > (bytes_.size() - at_) / least) {
      fail(
          fmt::format("found an array of {} elements, expected as many as the {} bytes that are "
                      "left hold",
                      count, bytes_.size() - at_));
    }
    return count;
  }

  void read_message(const MessageType& type, const Keys& outer_keys) {
    Keys own_keys;
    bool has_keys = false;
    const std::size_t depth = path_.size();
    for (const MessageField& field : type.fields) {
      const bool header = depth == 0 && field.type == FieldType::kMessage &&
                          field.array == ArrayKind::kNone && field.name == "header" &&
                          definition_->types[field.message].name == "std_msgs/Header";
      if (!header) path_.append(depth > 0 ? "." : "").append(field.name);
      const Keys& keys = has_keys ? own_keys : outer_keys;
      if (names_others(field)) {
        own_keys = read_names(field);
        has_keys = true;
      } else if (field.array == ArrayKind::kNone) {
        read_one(field, keys);
      } else {
        read_array(field, keys);
      }
      path_.resize(depth);
    }
  }

  Keys read_names(const MessageField& field) {
    Keys names;
    const std::size_t count = read_count(field, 4);
    if (count > kMostArrayElements && silent_ == 0) sink_->left_out(path_, "many names");
    names.reserve(std::min(count, kMostArrayElements));
    for (std::size_t i = 0; i < count; ++i) {
      const std::string_view name = read_text();
      if (i < kMostArrayElements) names.push_back(name);
    }
    if (count > kMostArrayElements || !may_be_keys(names)) names.clear();
    return names;
  }

  void read_array(const MessageField& field, const Keys& keys) {
    const bool messages = field.type == FieldType::kMessage;
    const std::size_t least = messages ? definition_->types[field.message].least_bytes : 1;
    const std::size_t count = read_count(field, least);
    // raw bytes are pictures and the like
    const bool raw = (field.type == FieldType::kUint8 || field.type == FieldType::kInt8) &&
                     field.array == ArrayKind::kSequence;
    const bool long_one = count > kMostArrayElements;
    if (raw) {
      if (count > 0 && silent_ == 0) sink_->left_out(path_, "bytes");
      at_ += count;
      return;
    }
    if (long_one && silent_ == 0) sink_->left_out(path_, "array of many elements");
    silent_ += long_one ? 1 : 0;
    const bool own_names =
        messages && std::any_of(definition_->types[field.message].fields.begin(),
                                definition_->types[field.message].fields.end(), names_others);
    const bool keyed = !keys.empty() && keys.size() == count && (!messages || own_names);
    const std::size_t depth = path_.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (silent_ == 0) {
        path_ += '[';
        path_ += keyed ? std::string(keys[i]) : std::to_string(i + 1);
        path_ += ']';
      }
      read_one(field, keys);
      path_.resize(depth);
    }
    silent_ -= long_one ? 1 : 0;
  }

  void number(double value) {
    if (silent_ == 0) sink_->number(path_, value);
  }
  void whole(std::int64_t value) {
    if (silent_ == 0) sink_->whole(path_, value);
  }

  void read_one(const MessageField& field, const Keys& keys) {
    switch (field.type) {
      case FieldType::kBool:
        return number(read<std::uint8_t>() != 0 ? 1 : 0);
      case FieldType::kInt8:
        return number(read<std::int8_t>());
      case FieldType::kUint8:
        return number(read<std::uint8_t>());
      case FieldType::kInt16:
        return number(read<std::int16_t>());
      case FieldType::kUint16:
        return number(read<std::uint16_t>());
      case FieldType::kInt32:
        return number(read<std::int32_t>());
      case FieldType::kUint32:
        return number(read<std::uint32_t>());
      case FieldType::kInt64:
        return whole(read<std::int64_t>());
      case FieldType::kUint64: {
        const auto value = read<std::uint64_t>();
        constexpr std::uint64_t kMostSigned = (1ULL << 63) - 1;
        return value <= kMostSigned ? whole(static_cast<std::int64_t>(value))
                                    : number(static_cast<double>(value));
      }
      case FieldType::kFloat32:
        return number(static_cast<double>(read<float>()));
      case FieldType::kFloat64:
        return number(read<double>());
      case FieldType::kString:
        read_text();
        if (silent_ == 0) sink_->left_out(path_, "text");
        return;
      case FieldType::kTime: {
        const std::int64_t seconds = most_alignment_ > 0
                                         ? static_cast<std::int64_t>(read<std::int32_t>())
                                         : static_cast<std::int64_t>(read<std::uint32_t>());
        const std::int64_t rest = read<std::uint32_t>();
        if (silent_ == 0) sink_->instant(path_, seconds * kNanosecondsPerSecond + rest);
        return;
      }
      case FieldType::kDuration: {
        const std::int64_t seconds = read<std::int32_t>();
        const std::int64_t rest = most_alignment_ > 0
                                      ? static_cast<std::int64_t>(read<std::uint32_t>())
                                      : static_cast<std::int64_t>(read<std::int32_t>());
        return number(static_cast<double>(seconds * kNanosecondsPerSecond + rest) / 1e9);
      }
      case FieldType::kMessage:
        read_message(definition_->types[field.message], keys);
    }
  }

  const MessageDefinition* definition_;
  std::string_view bytes_;
  FieldSink* sink_;
  std::size_t at_ = 0;              ///< the next byte
  std::size_t begin_ = 0;           ///< of values: alignment counts from here
  std::size_t most_alignment_ = 0;  ///< 0: packed
  bool swaps_ = false;              ///< big-endian
  int silent_ = 0;                  ///< within an array that is left out
  std::string path_;
};

}  // namespace

void MessageDecoder::decode(std::string_view bytes, FieldSink& sink) const {
  Decoding(definition_, encoding_, bytes, sink).run();
}

}  // namespace dyngen::runtime
