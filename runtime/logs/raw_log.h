// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// Columns of a log that share their rows: a table of text, a topic of a bag, a variable of a .mat
/// file.
struct LogTable {
  std::string name;  ///< topic, variable or dataset; empty: the log is one table
  /// As the log names them, without a unit in brackets; "1", "2", ... where it has no names.
  std::vector<std::string> columns;
  std::vector<std::string> units;  ///< one for each column, as written; empty: the log does not say
};

/// Some rows of one table.
struct LogRows {
  std::size_t table = 0;  ///< index in RawLog::tables()
  /// (rows x columns); NaN: no value. Whole numbers too large for a double (time stamps in ns) are
  /// counted from the first one of their column.
  Eigen::MatrixXd values;
  std::vector<std::uint64_t> places;  ///< (rows) RawLog::place_word() of each row, from 1
};

/// What cannot be read, with its place in the file where there is one.
class LogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a file of text does not say of itself. None: it is found out.
struct LogTextSettings {
  std::optional<char> separator;
  std::optional<char> decimal;
  std::size_t skip_lines = 0;                       ///< before the header, or before the first row
  std::optional<std::vector<std::string>> columns;  ///< names; the file has no header then
};

/// What was taken off all values of a column. An absolute value is count / counts_per_unit + value.
struct ColumnOrigin {
  std::int64_t count = 0;
  std::int64_t counts_per_unit = 1;  ///< 1e9: count is in ns, values are in s
};

/// A log as its writer left it, read piece by piece.
class RawLog {
 public:
  RawLog() = default;
  RawLog(const RawLog&) = delete;
  RawLog& operator=(const RawLog&) = delete;
  virtual ~RawLog() = default;

  [[nodiscard]] virtual const std::vector<LogTable>& tables() const = 0;

  /// Up to `at_most` (>= 1) further rows of one table, in the order of the file. Rows of several
  /// tables come in turn: no more than `at_most` rows in all are held back.
  /// @return false at the end of the log
  /// @throws LogError
  virtual bool next(LogRows& rows, std::size_t at_most) = 0;

  /// What a place is: "line", "message" or "row".
  [[nodiscard]] virtual std::string place_word() const = 0;

  /// What was repaired or left out, in sentences.
  [[nodiscard]] virtual std::vector<std::string> notices() const { return {}; }

  /// Of columns with whole numbers too large for a double, and with dates and times of day (ns
  /// since 1970 UTC; since midnight where the file has no date). Nothing: values are as written.
  /// Known once the first rows of the table have been read.
  [[nodiscard]] virtual std::optional<ColumnOrigin> origin(std::size_t /*table*/,
                                                           std::size_t /*column*/) const {
    return std::nullopt;
  }

  /// The word of a column of words if the first rows all have the same; else empty.
  [[nodiscard]] virtual std::string constant_word(std::size_t /*table*/,
                                                  std::size_t /*column*/) const {
    return {};
  }

  /// 0 .. 1: for progress.
  [[nodiscard]] virtual double fraction_read() const = 0;
};

/// Opens a log by what its bytes are, whatever its name is.
/// @throws LogError  if it cannot be read, or its format needs a package that this program was
/// built without
std::unique_ptr<RawLog> open_log(const std::string& path, const LogTextSettings& settings = {});

/// The same from memory; `name` stands in messages.
std::unique_ptr<RawLog> open_log_bytes(std::string bytes, const std::string& name,
                                       const LogTextSettings& settings = {});

}  // namespace dyngen::runtime
