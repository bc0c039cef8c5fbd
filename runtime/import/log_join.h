// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/import/column_lookup.h"
#include "runtime/import/table_window.h"
#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {

/// How a value is found between two samples of its table.
enum class Between {
  kLine,   ///< on the line through both
  kCubic,  ///< on the cubic through four
  kHold    ///< the earlier one: flags
};

/// A column of which each row of the join has a value.
struct JoinedColumn {
  ColumnPlace place;
  double delay = 0;  ///< s: the value of time t stands at t + delay
  Between between = Between::kLine;
  int bits = 0;  ///< of signed numbers that the log holds as unsigned ones
};

/// Where times come from.
struct JoinClock {
  double rate = 0;   ///< Hz; 0: a column
  std::string unit;  ///< of the map; empty: the log's own
};

/// Rows of several tables and logs as rows of one. The first column's table leads: each of its rows
/// becomes one, and tables that have a clock of their own are interpolated at its time. Tables
/// without a clock share their rows with it. Memory is that of the rows between which the tables
/// are apart: at most kMostHeld numbers.
///
/// Times above kWallClock are counted from the first one.
class LogJoin {
 public:
  static constexpr std::size_t kMostHeld = std::size_t{1} << 26;  ///< 512 MB
  static constexpr double kWallClock = 1e6;                       ///< s: eleven days
  static constexpr std::size_t kRowsAtOnce = 4096;
  static constexpr std::size_t kStepsOfTable = 33;  ///< whose median is a table's usual step

  /// @param logs  must outlive it
  /// @throws ImportError
  LogJoin(const ImportMap& map, std::vector<OpenedLog>& logs, const ColumnLookup& lookup,
          const std::vector<JoinedColumn>& columns, NoticeLog& log);

  /// The next row; NaN: no value.
  /// @param values  one for each column
  /// @throws RecordingError
  bool next(double& time, std::vector<double>& values, std::uint64_t& place);

  [[nodiscard]] double fraction_read() const;

  /// What the log's own values of a column, as far as they are read, look like.
  [[nodiscard]] const UnsignedWatch& watch(std::size_t column) const;

 private:
  enum class ClockKind { kOwn, kOfLead };
  struct Table {
    std::size_t log = 0, table = 0;
    TableWindow window;
    ClockKind clock = ClockKind::kOfLead;
    std::size_t clock_column = 0;  ///< kept
    UnitConversion to_seconds;
    std::size_t cursor = 0;  ///< last row at or before the time that is asked for
    std::size_t needed = 0;  ///< rows before it are not
    double usual_step = 0;   ///< s, from row to row; 0: not known yet
    std::array<double, kStepsOfTable> steps{};  ///< s, the last ones
    std::size_t step_count = 0;
    std::size_t steps_learnt = 0;  ///< up to this row
    bool counted = false;          ///< the next two are known
    double first_raw = 0;          ///< that is taken off values of the clock's column
    double shift = 0;              ///< s, that is added then
    bool any_used = false;
  };
  struct Source {
    std::size_t table = 0;  ///< in tables_
    std::size_t kept = 0;
    double delay = 0;
    Between between = Between::kLine;
    bool by_row = true;  ///< the lead's row, as it is
    std::size_t cursor = 0;
  };

  std::size_t table_of(const ColumnPlace& place);
  [[nodiscard]] std::string name_of(const Table& table) const;
  void set_clock(const ImportMap& map, const ColumnLookup& lookup,
                 const std::vector<JoinedColumn>& columns);
  UnitConversion seconds_of(const ImportMap& map, const ColumnLookup& lookup,
                            const ColumnPlace& place) const;
  bool pull(std::size_t log);
  bool ensure(std::size_t table, std::size_t row);
  [[nodiscard]] double time_of(std::size_t table, std::size_t row) const;
  void learn_step(std::size_t table, std::size_t row);
  enum class Found { kValue, kBefore, kAfter };
  Found interpolate(Source& source, double time, double& value);
  [[nodiscard]] std::optional<long double> origin_seconds(const Table& table) const;
  void set_base(std::uint64_t place);
  void count_from_base(Table& table);
  void check_rows_end();
  void release();

  std::vector<OpenedLog>* logs_;
  NoticeLog* log_;
  std::string map_name_;
  std::vector<Table> tables_;
  std::vector<Source> sources_;
  std::vector<bool> ended_;      ///< per log
  std::size_t clock_table_ = 0;  ///< in tables_, of the lead
  double rate_ = 0;
  double clock_raw_ = 0;  ///< the zero as a value of the lead's clock, which has no origin
  long double base_ = 0;  ///< s, absolute: the zero of the join's time
  bool base_known_ = false;
  bool other_clocks_ = false;
  std::size_t row_ = 0;  ///< of the lead
  double last_time_ = 0;
  bool any_row_ = false;
  LogRows rows_;
};

}  // namespace dyngen::runtime
