// SPDX-License-Identifier: MIT
#include "runtime/logs/array_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "runtime/logs/log_error.h"
#include "runtime/logs/log_words.h"

namespace dyngen::runtime {
namespace {

/// Shorter variables beside longer ones are not samples.
constexpr std::size_t kFewestArrayRows = 10;

/// "gain = 0.5", or the name alone if there is more than one number.
std::string words_of_short(const ArrayVariable& variable) {
  std::string name = variable.table.empty() ? variable.name : variable.table + "." + variable.name;
  if (variable.rows != 1 || variable.columns != 1) return name;
  Eigen::MatrixXd value(1, 1);
  variable.read(0, value);
  return fmt::format("{} = {}", name, value(0, 0));
}

struct ArrayTable {
  std::string name;
  std::size_t rows = 0;
  std::vector<std::size_t> variables;
};

class ArrayLog final : public RawLog {
 public:
  ArrayLog(std::vector<ArrayVariable> variables, std::vector<std::string> notices);

  [[nodiscard]] const std::vector<LogTable>& tables() const override { return tables_; }
  bool next(LogRows& rows, std::size_t at_most) override;
  [[nodiscard]] std::string place_word() const override { return "row"; }
  [[nodiscard]] std::vector<std::string> notices() const override { return notices_; }
  [[nodiscard]] std::optional<ColumnOrigin> origin(std::size_t table,
                                                   std::size_t column) const override;
  [[nodiscard]] double fraction_read() const override;

 private:
  void group();
  void describe(const ArrayTable& grouped);

  std::vector<ArrayVariable> variables_;
  std::vector<std::string> notices_;
  std::vector<ArrayTable> grouped_;
  std::vector<LogTable> tables_;
  std::size_t table_ = 0, row_ = 0;  ///< that come next
  std::size_t rows_read_ = 0, all_rows_ = 0;
};

ArrayLog::ArrayLog(std::vector<ArrayVariable> variables, std::vector<std::string> notices)
    : variables_(std::move(variables)), notices_(std::move(notices)) {
  group();
  for (const ArrayTable& grouped : grouped_) describe(grouped);
}

void ArrayLog::group() {
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const ArrayVariable& variable = variables_[i];
    const auto same = [&](const ArrayTable& table) {
      return table.name == variable.table && table.rows == variable.rows;
    };
    auto found = std::find_if(grouped_.begin(), grouped_.end(), same);
    if (found == grouped_.end()) {
      grouped_.push_back({variable.table, variable.rows, {}});
      found = grouped_.end() - 1;
      all_rows_ += variable.rows;
    }
    found->variables.push_back(i);
  }
}

void ArrayLog::describe(const ArrayTable& grouped) {
  LogTable table;
  table.name = grouped.name;
  const auto same_name = [&](const LogTable& other) { return other.name == table.name; };
  if (std::any_of(tables_.begin(), tables_.end(), same_name)) {
    table.name += fmt::format("{}({} rows)", table.name.empty() ? "" : " ", grouped.rows);
  }
  for (const std::size_t index : grouped.variables) {
    const ArrayVariable& variable = variables_[index];
    for (std::size_t k = 0; k < variable.columns; ++k) {
      table.columns.push_back(!variable.column_names.empty() ? variable.column_names[k]
                              : variable.columns == 1
                                  ? variable.name
                                  : fmt::format("{}[{}]", variable.name, k + 1));
      table.units.push_back(variable.unit);
    }
  }
  make_unique(table.columns);
  tables_.push_back(std::move(table));
}

bool ArrayLog::next(LogRows& rows, std::size_t at_most) {
  while (table_ < grouped_.size() && row_ == grouped_[table_].rows) {
    ++table_;
    row_ = 0;
  }
  if (table_ == grouped_.size()) return false;
  const ArrayTable& grouped = grouped_[table_];
  const std::size_t count = std::min(std::max<std::size_t>(at_most, 1), grouped.rows - row_);
  rows.table = table_;
  rows.places.resize(count);
  std::iota(rows.places.begin(), rows.places.end(), row_ + 1);
  rows.values.resize(static_cast<Eigen::Index>(count),
                     static_cast<Eigen::Index>(tables_[table_].columns.size()));
  Eigen::Index column = 0;
  for (const std::size_t index : grouped.variables) {
    const ArrayVariable& variable = variables_[index];
    const auto width = static_cast<Eigen::Index>(variable.columns);
    variable.read(row_, rows.values.middleCols(column, width));
    column += width;
  }
  rows.values = rows.values.unaryExpr([](double value) {
    return std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
  });
  row_ += count;
  rows_read_ += count;
  return true;
}

std::optional<ColumnOrigin> ArrayLog::origin(std::size_t table, std::size_t column) const {
  std::size_t begin = 0;
  for (const std::size_t index : grouped_[table].variables) {
    if (column < begin + variables_[index].columns) return variables_[index].origin;
    begin += variables_[index].columns;
  }
  return std::nullopt;
}

double ArrayLog::fraction_read() const {
  return all_rows_ == 0 ? 1 : static_cast<double>(rows_read_) / static_cast<double>(all_rows_);
}

}  // namespace

std::unique_ptr<RawLog> make_array_log(std::vector<ArrayVariable> variables,
                                       std::vector<std::string> notices, const std::string& file) {
  const auto is_short = [](const ArrayVariable& variable) {
    return variable.rows < kFewestArrayRows;
  };
  if (!std::all_of(variables.begin(), variables.end(), is_short)) {
    std::vector<std::string> constants;
    for (const ArrayVariable& variable : variables) {
      if (is_short(variable)) constants.push_back(words_of_short(variable));
    }
    std::erase_if(variables, is_short);
    if (!constants.empty()) {
      notices.push_back(
          log_notice(file, fmt::format("left out as constants (fewer than {} rows): {}",
                                       kFewestArrayRows, fmt::join(constants, ", "))));
    }
  }
  if (variables.empty()) {
    std::string why;
    for (const std::string& notice : notices) why += "\n" + notice;
    throw LogError(log_error(file, "found no numbers that can be read").what() + why);
  }
  return std::make_unique<ArrayLog>(std::move(variables), std::move(notices));
}

bool samples_are_second(std::size_t first, std::size_t second) { return second > first; }

}  // namespace dyngen::runtime
