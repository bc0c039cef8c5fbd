// SPDX-License-Identifier: MIT
#include "runtime/logs/json_walk.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "runtime/logs/json_values.h"
#include "runtime/logs/log_error.h"
#include "runtime/logs/log_words.h"
#include "runtime/logs/time_words.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kDeepestJson = 64;
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// The path of the value that begins.
bool JsonWalk::at_value() {
  if (frames_.empty() || !frames_.back().array) return true;
  Frame& frame = frames_.back();
  ++frame.index;
  path_.resize(frame.path);
  path_ += path_.empty() ? std::to_string(frame.index) : fmt::format("[{}]", frame.index);
  return true;
}

bool JsonWalk::enter(bool array) {
  at_value();
  if (frames_.size() >= kDeepestJson) {
    error_ = fmt::format("found values nested more than {} deep", kDeepestJson);
    return false;
  }
  frames_.push_back({array, 0, path_.size()});
  entered();
  return true;
}

bool JsonWalk::leave() {
  left();
  path_.resize(std::min(path_.size(), frames_.back().path));
  frames_.pop_back();
  return true;
}

bool JsonWalk::key(string_t& name) {
  path_.resize(frames_.back().path);
  if (!path_.empty()) path_ += '.';
  path_ += name;
  return true;
}

bool JsonWalk::boolean(bool value) {
  at_value();
  if (FieldSink* out = sink()) {
    out->number(path_, value ? 1 : 0);
  } else {
    outside_value(value ? 1 : 0);
  }
  return true;
}

bool JsonWalk::number_integer(number_integer_t value) {
  at_value();
  if (FieldSink* out = sink()) {
    out->whole(path_, value);
  } else {
    outside_value(static_cast<double>(value));
  }
  return true;
}

bool JsonWalk::number_unsigned(number_unsigned_t value) {
  constexpr auto kMost = static_cast<number_unsigned_t>(std::numeric_limits<std::int64_t>::max());
  if (value <= kMost) return number_integer(static_cast<number_integer_t>(value));
  return number_float(static_cast<double>(value), {});
}

bool JsonWalk::number_float(number_float_t value, const string_t&) {
  at_value();
  if (FieldSink* out = sink()) {
    out->number(path_, value);
  } else {
    outside_value(value);
  }
  return true;
}

bool JsonWalk::string(string_t& text) {
  at_value();
  FieldSink* out = sink();
  if (out == nullptr) {
    outside_value(kNoNumber);
    return true;
  }
  std::string scratch;
  const WordKind kind = kind_of_word(text);
  if (kind == WordKind::kTime) {
    if (const auto time = read_time_word(text)) out->instant(path_, time->nanoseconds);
  } else if (kind == WordKind::kNumber) {
    if (const auto value = value_of_word(text, '.', scratch)) out->number(path_, *value);
  } else if (kind == WordKind::kText) {
    out->left_out(path_, "text");
  }
  return true;
}

bool JsonWalk::parse_error(std::size_t place, const std::string& token,
                           const nlohmann::json::exception&) {
  error_ = fmt::format("byte {}: found {}, expected JSON", place, in_quotes(token));
  return false;
}

void walk_json(std::string_view text, JsonWalk& walk) {
  std::string plain;
  if (text.find("NaN") != text.npos || text.find("Infinity") != text.npos ||
      text.find("nan") != text.npos) {
    plain = plain_json(text);
    text = plain;
  }
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &walk)) {
    throw std::runtime_error(walk.error().empty() ? "found what is no JSON" : walk.error());
  }
}

}  // namespace dyngen::runtime
