// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/logs/message_decoder.h"

namespace dyngen::runtime {

/// Goes through a text of JSON and knows where it is: "a.b[2]" ("2" in an array that is all).
/// Memory is bounded by the depth and the longest text.
class JsonWalk : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return at_value(); }
  bool boolean(bool value) override;
  bool number_integer(number_integer_t value) override;
  bool number_unsigned(number_unsigned_t value) override;
  bool number_float(number_float_t value, const string_t& text) override;
  bool string(string_t& text) override;
  bool binary(binary_t&) override { return at_value(); }
  bool start_object(std::size_t) override { return enter(false); }
  bool key(string_t& name) override;
  bool end_object() override { return leave(); }
  bool start_array(std::size_t) override { return enter(true); }
  bool end_array() override { return leave(); }
  bool parse_error(std::size_t place, const std::string& token,
                   const nlohmann::json::exception& error) override;

  /// What went wrong, a sentence with the byte.
  [[nodiscard]] const std::string& error() const { return error_; }

 protected:
  struct Frame {
    bool array = false;
    std::size_t index = 0;  ///< of the element that was begun last, from 1
    std::size_t path = 0;   ///< length of the path of this container
  };

  /// Where numbers go now; null: nowhere.
  virtual FieldSink* sink() = 0;
  /// A value that is no container stands where sink() is null; NaN for text.
  virtual void outside_value(double /*number*/) {}
  virtual void entered() {}  ///< frames_.back() is new
  virtual void left() {}     ///< frames_.back() is about to go

  std::string path_;
  std::vector<Frame> frames_;

 private:
  bool at_value();
  bool enter(bool array);
  bool leave();

  std::string error_;
};

/// One object or array is one row.
class JsonRowWalk final : public JsonWalk {
 public:
  explicit JsonRowWalk(FieldSink& sink) : sink_(&sink) {}

 private:
  FieldSink* sink() override { return sink_; }
  FieldSink* sink_;
};

/// @throws std::runtime_error, a sentence with the byte
void walk_json(std::string_view text, JsonWalk& walk);

}  // namespace dyngen::runtime
