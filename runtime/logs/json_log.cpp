// SPDX-License-Identifier: MIT
#include "runtime/logs/json_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "runtime/logs/array_log.h"
#include "runtime/logs/json_sides.h"
#include "runtime/logs/json_table.h"
#include "runtime/logs/json_walk.h"
#include "runtime/logs/log_error.h"
#include "runtime/logs/message_log.h"
#include "runtime/recordings/columns.h"
#include "runtime/recordings/line_reader.h"

namespace dyngen::runtime {
namespace {

/// Documents are read into memory; longer ones are JSON lines, or should be.
constexpr std::size_t kMostDocumentBytes = std::size_t{1} << 29;

/// Lines of JSON as messages.
class JsonLines final : public MessageSource {
 public:
  JsonLines(std::function<ByteSource()> open, std::string name)
      : open_(std::move(open)), name_(std::move(name)) {
    MessageTopic topic;
    topic.encoding = "json";
    topics_.push_back(topic);
    JsonLines::rewind();
  }

  [[nodiscard]] const std::vector<MessageTopic>& topics() const override { return topics_; }
  [[nodiscard]] std::string place_word() const override { return "line"; }
  [[nodiscard]] bool has_received() const override { return false; }
  [[nodiscard]] double fraction_read() const override { return lines_->fraction_read(); }

  void rewind() override {
    log_ = std::make_unique<NoticeLog>(name_, 1);
    lines_ = std::make_unique<LineReader>(open_(), *log_);
  }

  bool next(LogMessage& message) override {
    try {
      Line line;
      while (lines_->next(line)) {
        if (trimmed(line.text).empty()) continue;
        message = {0, 0, line.text, line.number};
        return true;
      }
    } catch (const std::runtime_error& error) {
      throw LogError(error.what());
    }
    return false;
  }

 private:
  std::function<ByteSource()> open_;
  std::string name_;
  std::vector<MessageTopic> topics_;
  std::unique_ptr<NoticeLog> log_;
  std::unique_ptr<LineReader> lines_;
};

/// True if the second line begins another value: the first one is whole then.
bool are_lines(const std::function<ByteSource()>& open, const std::string& name) {
  try {
    NoticeLog log(name, 1);
    LineReader lines(open(), log);
    std::vector<std::string> first;
    for (Line line; first.size() < 2 && lines.next(line);) {
      if (!trimmed(line.text).empty()) first.emplace_back(trimmed(line.text));
    }
    if (first.size() < 2) return false;
    const char closes = first[0].front() == '{' ? '}' : ']';
    return first[0].size() > 1 && first[0].back() == closes && first[1].front() == first[0].front();
  } catch (const std::runtime_error&) {
    return false;  // a line of more than 1 MB: a document
  }
}

/// A whole document: arrays become tables and columns, other numbers are told.
class JsonDocument final : public JsonWalk {
 public:
  /// Arrays of objects by their path; arrays of numbers and of arrays by the path of what they are
  /// part of, and their name.
  std::map<std::string, JsonTable> objects;
  JsonArrays arrays;
  std::vector<std::string> constants;

 private:
  FieldSink* sink() override { return sink_; }

  [[nodiscard]] bool in_outer_array() const {
    return sink_ == nullptr && !frames_.empty() && frames_.back().array;
  }

  /// The table of numbers and arrays that are elements of an array outside of rows.
  JsonTable& array_table(std::size_t path_size) {
    const std::string path = path_.substr(0, path_size);
    const std::size_t point = path.rfind('.');
    const JsonArrayName name = point == path.npos
                                   ? JsonArrayName{std::string(), path}
                                   : JsonArrayName{path.substr(0, point), path.substr(point + 1)};
    return arrays.try_emplace(name, kMostJsonSamples).first->second;
  }
  [[nodiscard]] std::string array_name(std::size_t path_size) const {
    const std::string path = path_.substr(0, path_size);
    return path.substr(path.rfind('.') + 1);
  }

  void entered() override {
    if (sink_ != nullptr || frames_.size() < 2 || !frames_[frames_.size() - 2].array) return;
    const Frame& outer = frames_[frames_.size() - 2];
    const bool object = !frames_.back().array;
    JsonTable& table = object ? objects[path_.substr(0, outer.path)] : array_table(outer.path);
    table.begin_row(outer.index - 1);
    sink_ = &table;
    row_depth_ = frames_.size();
    outer_path_ = path_;
    path_ = object ? std::string() : array_name(outer.path);
    frames_.back().path = path_.size();
  }
  void left() override {
    if (sink_ == nullptr || frames_.size() != row_depth_) return;
    sink_ = nullptr;
    path_ = outer_path_;
    frames_.back().path = path_.size();
  }
  void outside_value(double number) override {
    if (!in_outer_array()) {
      constexpr std::size_t kMostConstants = 1000;
      if (!std::isnan(number) && constants.size() < kMostConstants) {
        constants.push_back(fmt::format("{} = {}", path_, number));
      }
      return;
    }
    const Frame& outer = frames_.back();
    JsonTable& table = array_table(outer.path);
    table.begin_row(outer.index - 1);
    const std::string name = array_name(outer.path);
    table.number(name.empty() ? "1" : name, number);
  }

  JsonTable* sink_ = nullptr;
  std::size_t row_depth_ = 0;
  std::string outer_path_;
};

void add_variables(JsonTable& table, const std::string& name,
                   std::vector<ArrayVariable>& variables) {
  for (JsonColumn& column : table.columns()) {
    ArrayVariable variable;
    variable.table = name;
    variable.name = column.name;
    variable.rows = table.rows();
    variable.unit = column.instant ? "s" : "";
    variable.origin = column.origin;
    auto samples = std::make_shared<std::vector<JsonSample>>(std::move(column.samples));
    variable.read = [samples](std::size_t begin, Eigen::Ref<Eigen::MatrixXd> block) {
      block.setConstant(std::numeric_limits<double>::quiet_NaN());
      const auto before = [](const JsonSample& sample, std::size_t row) {
        return sample.row < row;
      };
      auto next = std::lower_bound(samples->begin(), samples->end(), begin, before);
      const std::size_t end = begin + static_cast<std::size_t>(block.rows());
      for (; next != samples->end() && next->row < end; ++next) {
        block(static_cast<Eigen::Index>(next->row - begin), 0) = next->value;
      }
    };
    variables.push_back(std::move(variable));
  }
}

std::string all_bytes(ByteSource source, const std::string& name) {
  std::string text;
  std::string piece(1 << 18, '\0');
  while (const std::size_t got = source.read(piece.data(), piece.size())) {
    text.append(piece, 0, got);
    if (text.size() > kMostDocumentBytes) {
      throw log_error(name,
                      fmt::format("found a JSON document of more than {} MB, expected less; "
                                  "write one object a line (JSON lines), which needs no memory",
                                  kMostDocumentBytes >> 20));
    }
  }
  return text;
}

std::unique_ptr<RawLog> open_document(const std::function<ByteSource()>& open,
                                      const std::string& name) {
  std::string text = all_bytes(open(), name);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  JsonDocument document;
  walk_json(text, document);
  std::vector<std::string> notices;
  std::vector<ArrayVariable> variables;
  for (auto& [path, table] : document.objects) {
    add_variables(table, path, variables);
    if (!table.texts().empty()) {
      notices.push_back(log_notice(
          name, fmt::format("{} of {} is left out (text)", few_names(table.texts()), path)));
    }
  }
  const std::vector<std::string> turned =
      turn_channels(document.arrays, !document.objects.empty(), name);
  if (!turned.empty()) {
    notices.push_back(
        log_notice(name, fmt::format("lists of {} are channels, not samples", few_names(turned))));
  }
  for (auto& [path, table] : document.arrays) add_variables(table, path.first, variables);
  if (!document.constants.empty()) {
    constexpr std::size_t kShown = 20;
    const std::size_t shown = std::min(kShown, document.constants.size());
    notices.push_back(log_notice(
        name, fmt::format(
                  "constants beside the tables: {}{}",
                  fmt::join(document.constants.begin(),
                            document.constants.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                  shown < document.constants.size() ? ", ..." : "")));
  }
  return make_array_log(std::move(variables), std::move(notices), name);
}

}  // namespace

std::unique_ptr<RawLog> open_json_log(const std::function<ByteSource()>& open,
                                      const std::string& name) {
  if (are_lines(open, name)) {
    return open_message_log(std::make_unique<JsonLines>(open, name), name);
  }
  try {
    return open_document(open, name);
  } catch (const LogError&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw log_error(name, error.what());
  }
}

}  // namespace dyngen::runtime
