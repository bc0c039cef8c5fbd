// SPDX-License-Identifier: MIT
#include "runtime/logs/message_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "runtime/logs/log_error.h"
#include "runtime/logs/message_readers.h"
#include "runtime/logs/row_rounds.h"
#include "runtime/logs/time_words.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kMostColumns = 5000;  ///< of a topic
constexpr double kUnset = std::numeric_limits<double>::quiet_NaN();
const double kMostExact = std::ldexp(1.0, 53);  ///< whole numbers up to it are doubles

struct PathHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const {
    return std::hash<std::string_view>()(text);
  }
};

struct ColumnState {
  std::size_t place = 0;
  bool instant = false;                ///< a point in time
  std::optional<std::int64_t> origin;  ///< of whole numbers that a double does not hold
};

/// A topic of which something can be read.
struct TopicTable {
  std::size_t table = 0;
  std::unique_ptr<MessageReader> reader;
  std::unordered_map<std::string, ColumnState, PathHash, std::equal_to<>> columns;
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::string>> left_out;         ///< why -> paths
  std::unordered_set<std::string, PathHash, std::equal_to<>> seen;  ///< paths that were left out
  std::size_t beyond_columns = 0;
};

/// The first way through: which columns there are.
class ColumnCollector final : public FieldSink {
 public:
  explicit ColumnCollector(std::optional<std::int64_t>& first_instant)
      : first_instant_(&first_instant) {}
  void use(TopicTable& table) { table_ = &table; }

  void number(std::string_view path, double) override { column(path); }
  void whole(std::string_view path, std::int64_t value) override {
    ColumnState* found = column(path);
    if (found == nullptr || found->origin) return;
    if (std::abs(static_cast<double>(value)) > kMostExact) found->origin = value;
  }
  void instant(std::string_view path, std::int64_t nanoseconds) override {
    ColumnState* found = column(path);
    if (found != nullptr) found->instant = true;
    if (!*first_instant_ && nanoseconds != 0) *first_instant_ = nanoseconds;
  }
  void left_out(std::string_view path, std::string_view what) override {
    if (table_->seen.find(path) != table_->seen.end()) return;
    if (table_->seen.size() < kMostColumns) table_->seen.emplace(path);
    // one element of an array stands for all
    std::string plain;
    bool inside = false;
    for (const char c : path) {
      if (c == '[') inside = true;
      if (!inside) plain += c;
      if (c == ']') inside = false;
    }
    auto& paths = table_->left_out[std::string(what)];
    if (std::find(paths.begin(), paths.end(), plain) == paths.end() &&
        paths.size() < kMostColumns) {
      paths.push_back(plain);
    }
  }

 private:
  ColumnState* column(std::string_view path) {
    const auto known = table_->columns.find(path);
    if (known != table_->columns.end()) return &known->second;
    if (table_->names.size() >= kMostColumns) {
      ++table_->beyond_columns;
      return nullptr;
    }
    table_->names.emplace_back(path);
    ColumnState state;
    state.place = table_->names.size() - 1;
    return &table_->columns.emplace(std::string(path), state).first->second;
  }

  std::optional<std::int64_t>* first_instant_;
  TopicTable* table_ = nullptr;
};

/// The second way through: the values of one row.
class RowFiller final : public FieldSink {
 public:
  RowFiller(const TopicTable& table, std::int64_t instant_origin, double* row)
      : table_(&table), instant_origin_(instant_origin), row_(row) {}

  void number(std::string_view path, double value) override {
    if (const ColumnState* found = column(path)) put(*found, value);
  }
  void whole(std::string_view path, std::int64_t value) override {
    const ColumnState* found = column(path);
    if (found == nullptr) return;
    std::int64_t counted = value;
    const bool beyond = found->origin && __builtin_sub_overflow(value, *found->origin, &counted);
    put(*found, beyond ? static_cast<double>(value) - static_cast<double>(*found->origin)
                       : static_cast<double>(counted));
  }
  void instant(std::string_view path, std::int64_t nanoseconds) override {
    const ColumnState* found = column(path);
    if (found == nullptr) return;
    // 0 is what nobody has set, unless the clock begins near it
    const bool unset = nanoseconds == 0 && std::abs(static_cast<double>(instant_origin_)) >
                                               static_cast<double>(kNanosecondsPerDay);
    std::int64_t counted = 0;
    const bool beyond = __builtin_sub_overflow(nanoseconds, instant_origin_, &counted);
    put(*found, unset || beyond ? kUnset : static_cast<double>(counted) / 1e9);
  }
  void left_out(std::string_view, std::string_view) override {}

 private:
  [[nodiscard]] const ColumnState* column(std::string_view path) const {
    const auto known = table_->columns.find(path);
    return known != table_->columns.end() ? &known->second : nullptr;
  }
  void put(const ColumnState& column, double value) {
    row_[column.place] = std::isfinite(value) ? value : kUnset;
  }

  const TopicTable* table_;
  std::int64_t instant_origin_;
  double* row_;
};

class MessageLog final : public RawLog {
 public:
  MessageLog(std::unique_ptr<MessageSource> source, std::string name);

  [[nodiscard]] const std::vector<LogTable>& tables() const override { return tables_; }
  bool next(LogRows& rows, std::size_t at_most) override;
  [[nodiscard]] std::string place_word() const override { return source_->place_word(); }
  [[nodiscard]] std::vector<std::string> notices() const override;
  [[nodiscard]] std::optional<ColumnOrigin> origin(std::size_t table,
                                                   std::size_t column) const override;
  [[nodiscard]] double fraction_read() const override;

 private:
  void collect();
  TopicTable* table_of(std::size_t topic);
  bool next_row();
  void tell();
  [[noreturn]] void refuse(const LogMessage& message, const std::runtime_error& error) const;

  std::unique_ptr<MessageSource> source_;
  std::string name_;
  std::vector<std::unique_ptr<TopicTable>> topics_;  ///< null: nothing of it can be read
  std::vector<bool> known_;                          ///< topics that were looked at
  std::vector<LogTable> tables_;
  std::vector<std::size_t> topic_of_table_;
  std::optional<std::int64_t> first_received_, first_instant_;
  std::vector<std::string> notices_;
  RowRounds rounds_{{}};
  bool at_end_ = false;
};

MessageLog::MessageLog(std::unique_ptr<MessageSource> source, std::string name)
    : source_(std::move(source)), name_(std::move(name)) {
  collect();
  std::vector<std::size_t> widths;
  for (std::size_t topic = 0; topic < topics_.size(); ++topic) {
    TopicTable* found = topics_[topic].get();
    if (found == nullptr) continue;
    LogTable table;
    table.name = source_->topics()[topic].name;
    table.columns = found->names;
    table.units.resize(table.columns.size());
    for (const auto& [path, column] : found->columns) {
      if (column.instant) table.units[column.place] = "s";
    }
    if (source_->has_received()) table.units[0] = "s";
    found->table = tables_.size();
    topic_of_table_.push_back(topic);
    widths.push_back(table.columns.size());
    tables_.push_back(std::move(table));
  }
  tell();
  if (tables_.empty()) {
    std::string why;
    for (const std::string& notice : notices_) why += "\n" + notice;
    throw LogError(log_error(name_, "found no messages that can be read").what() + why);
  }
  rounds_ = RowRounds(widths);
  source_->rewind();
}

/// The table of a topic; null if it cannot be read.
TopicTable* MessageLog::table_of(std::size_t topic) {
  if (topic >= known_.size()) {
    known_.resize(topic + 1, false);
    topics_.resize(topic + 1);
  }
  if (known_[topic]) return topics_[topic].get();
  known_[topic] = true;
  const MessageTopic& described = source_->topics()[topic];
  try {
    auto table = std::make_unique<TopicTable>();
    table->reader = reader_of_topic(described);
    if (source_->has_received()) table->names.emplace_back("received");
    topics_[topic] = std::move(table);
  } catch (const std::runtime_error& error) {
    notices_.push_back(log_notice(
        name_, fmt::format("topic {} is left out: {}", in_quotes(described.name), error.what())));
  }
  return topics_[topic].get();
}

void MessageLog::refuse(const LogMessage& message, const std::runtime_error& error) const {
  const std::string& topic = source_->topics()[message.topic].name;
  throw log_error_at(name_, source_->place_word(), message.place,
                     topic.empty() ? std::string(error.what())
                                   : fmt::format("topic {}: {}", in_quotes(topic), error.what()));
}

void MessageLog::collect() {
  ColumnCollector collector(first_instant_);
  for (LogMessage message; source_->next(message);) {
    if (!first_received_) first_received_ = message.received;
    TopicTable* table = table_of(message.topic);
    if (table == nullptr) continue;
    collector.use(*table);
    try {
      table->reader->read(message.bytes, collector);
    } catch (const LogError&) {
      throw;
    } catch (const std::runtime_error& error) {
      refuse(message, error);
    }
  }
}

void MessageLog::tell() {
  for (const std::size_t topic : topic_of_table_) {
    const TopicTable& table = *topics_[topic];
    const std::string& name = source_->topics()[topic].name;
    const std::string where = name.empty() ? std::string() : fmt::format(" of {}", in_quotes(name));
    for (const auto& [why, paths] : table.left_out) {
      notices_.push_back(
          log_notice(name_, fmt::format("{}{} is left out ({})", few_names(paths), where, why)));
    }
    if (table.beyond_columns > 0) {
      notices_.push_back(log_notice(
          name_,
          fmt::format("numbers beyond the first {} columns{} are left out", kMostColumns, where)));
    }
  }
}

bool MessageLog::next_row() {
  for (LogMessage message; source_->next(message);) {
    if (message.topic >= topics_.size() || topics_[message.topic] == nullptr) continue;
    const TopicTable& table = *topics_[message.topic];
    double* row = rounds_.add(table.table, message.place);
    if (source_->has_received()) {
      std::int64_t counted = 0;
      const bool beyond = __builtin_sub_overflow(message.received, *first_received_, &counted);
      row[0] = beyond ? kUnset : static_cast<double>(counted) / 1e9;
    }
    RowFiller filler(table, first_instant_.value_or(0), row);
    try {
      table.reader->read(message.bytes, filler);
    } catch (const LogError&) {
      throw;
    } catch (const std::runtime_error& error) {
      refuse(message, error);
    }
    return true;
  }
  return false;
}

bool MessageLog::next(LogRows& rows, std::size_t at_most) {
  const std::size_t wanted = std::max<std::size_t>(at_most, 1);
  if (rounds_.waiting() == 0) {
    while (!at_end_ && rounds_.waiting() < wanted) at_end_ = !next_row();
  }
  if (rounds_.waiting() == 0) return false;
  rounds_.take(rows, wanted);
  return true;
}

std::vector<std::string> MessageLog::notices() const {
  std::vector<std::string> all = source_->notices();
  all.insert(all.end(), notices_.begin(), notices_.end());
  return all;
}

std::optional<ColumnOrigin> MessageLog::origin(std::size_t table, std::size_t column) const {
  if (source_->has_received() && column == 0) {
    return ColumnOrigin{*first_received_, kNanosecondsPerSecond};
  }
  for (const auto& [path, state] : topics_[topic_of_table_[table]]->columns) {
    if (state.place != column) continue;
    if (state.instant) return ColumnOrigin{first_instant_.value_or(0), kNanosecondsPerSecond};
    if (state.origin) return ColumnOrigin{*state.origin, 1};
  }
  return std::nullopt;
}

double MessageLog::fraction_read() const { return at_end_ ? 1 : source_->fraction_read(); }

}  // namespace

std::unique_ptr<RawLog> open_message_log(std::unique_ptr<MessageSource> source,
                                         const std::string& name) {
  return std::make_unique<MessageLog>(std::move(source), name);
}

}  // namespace dyngen::runtime
