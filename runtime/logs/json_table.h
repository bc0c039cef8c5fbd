// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "runtime/logs/message_decoder.h"
#include "runtime/logs/raw_log.h"
#include "runtime/logs/time_words.h"

namespace dyngen::runtime {

inline constexpr std::size_t kMostJsonColumns = 5000;
/// Lists within a list may be channels: numbers in one, some 100 bytes of memory for each.
inline constexpr std::size_t kMostJsonSamples = 1'000'000;

/// A value of a column.
struct JsonSample {
  std::size_t row = 0;
  double value = 0;
};

struct JsonColumn {
  std::string name;
  std::vector<JsonSample> samples;
  std::optional<ColumnOrigin> origin;
  bool instant = false;
};

/// Columns of one array of a document.
class JsonTable final : public FieldSink {
 public:
  explicit JsonTable(std::size_t most_columns = kMostJsonColumns) : most_(most_columns) {}
  void begin_row(std::size_t row) {
    row_ = row;
    rows_ = std::max(rows_, row + 1);
  }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] std::vector<JsonColumn>& columns() { return columns_; }
  [[nodiscard]] const std::vector<JsonColumn>& columns() const { return columns_; }
  /// In place of what it has.
  void set_columns(std::vector<JsonColumn> columns, std::size_t rows) {
    columns_ = std::move(columns);
    rows_ = rows;
  }
  [[nodiscard]] const std::vector<std::string>& texts() const { return texts_; }
  /// Some columns were too many.
  [[nodiscard]] bool overflowed() const { return overflowed_; }

  void number(std::string_view path, double value) override {
    if (JsonColumn* found = column(path)) found->samples.push_back({row_, value});
  }
  void whole(std::string_view path, std::int64_t value) override {
    counted(path, value, 1, std::abs(static_cast<double>(value)) > std::ldexp(1.0, 53));
  }
  void instant(std::string_view path, std::int64_t nanoseconds) override {
    counted(path, nanoseconds, kNanosecondsPerSecond, true);
  }
  void left_out(std::string_view path, std::string_view) override {
    const std::string name(path);
    if (texts_.size() < kMostJsonColumns &&
        std::find(texts_.begin(), texts_.end(), name) == texts_.end()) {
      texts_.push_back(name);
    }
  }

 private:
  void counted(std::string_view path, std::int64_t value, std::int64_t per_unit, bool from_first) {
    JsonColumn* found = column(path);
    if (found == nullptr) return;
    if (from_first && !found->origin) found->origin = ColumnOrigin{value, per_unit};
    found->instant = found->instant || per_unit != 1;
    std::int64_t difference = value;
    if (found->origin && __builtin_sub_overflow(value, found->origin->count, &difference)) return;
    found->samples.push_back(
        {row_, static_cast<double>(difference) / static_cast<double>(per_unit)});
  }
  JsonColumn* column(std::string_view path) {
    const std::string name(path);
    const auto [known, is_new] = places_.try_emplace(name, columns_.size());
    if (is_new) {
      if (columns_.size() >= most_) {
        places_.erase(known);
        overflowed_ = true;
        return nullptr;
      }
      columns_.push_back({name, {}, {}, false});
    }
    return &columns_[known->second];
  }

  std::size_t most_;
  std::unordered_map<std::string, std::size_t> places_;
  std::vector<JsonColumn> columns_;
  std::vector<std::string> texts_;
  std::size_t row_ = 0, rows_ = 0;
  bool overflowed_ = false;
};

}  // namespace dyngen::runtime
