// SPDX-License-Identifier: MIT
#include "runtime/import/log_join.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dyngen::runtime {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
constexpr double kJoinGapSteps = 5;  // usual steps: over a longer gap nothing is interpolated

/// Through four points, in Lagrange's form.
double cubic(const std::array<double, 4>& t, const std::array<double, 4>& x, double time) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j != i) weight *= (time - t[j]) / (t[i] - t[j]);
    }
    sum += weight * x[i];
  }
  return sum;
}

}  // namespace

std::size_t LogJoin::table_of(const ColumnPlace& place) {
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    if (tables_[i].log == place.log && tables_[i].table == place.table) return i;
  }
  Table table;
  table.log = place.log;
  table.table = place.table;
  tables_.push_back(std::move(table));
  return tables_.size() - 1;
}

/// Of a table, for messages; of a log that is one table, the log's.
std::string LogJoin::name_of(const Table& table) const {
  const OpenedLog& log = (*logs_)[table.log];
  const std::string& name = log.log->tables()[table.table].name;
  return name.empty() ? log.path : name;
}

UnitConversion LogJoin::seconds_of(const ImportMap& map, const ColumnLookup& lookup,
                                   const ColumnPlace& place) const {
  if (map.time.rate > 0) return {1, map.time.rate, 0};
  const std::string& unit = map.time.unit.empty() ? place.unit : map.time.unit;
  if (unit.empty()) {
    lookup.fail(map.time.place,
                fmt::format("found no unit of time, and the log has none for {}: "
                            "expected 'unit', {}",
                            runtime::quoted(place.name), known_units(ColumnQuantity::kTime)));
  }
  const auto conversion = unit_conversion(unit, ColumnQuantity::kTime);
  if (!conversion) {
    lookup.fail(map.time.place, fmt::format("found unit {} of {} in the log, expected {}; 'unit' "
                                            "in the map overrides it",
                                            runtime::quoted(unit), runtime::quoted(place.name),
                                            known_units(ColumnQuantity::kTime)));
  }
  return *conversion;
}

void LogJoin::set_clock(const ImportMap& map, const ColumnLookup& lookup,
                        const std::vector<JoinedColumn>& columns) {
  if (map.time.column.empty()) rate_ = map.time.rate;
  if (rate_ > 0) return;
  const ColumnPlace& lead = columns.front().place;
  std::optional<ColumnPlace> clock = lookup.clock_of(lead);
  if (!clock)
    clock = lookup.find(map.time.place, {}, {}, map.time.column, ColumnQuantity::kTime, true);
  clock_table_ = table_of(*clock);
  const auto own = [&](std::size_t table, const ColumnPlace& place) {
    tables_[table].clock = ClockKind::kOwn;
    tables_[table].clock_column = tables_[table].window.keep_column(place.column);
    tables_[table].to_seconds = seconds_of(map, lookup, place);
  };
  own(clock_table_, *clock);
  if (!clock->same_table(lead)) return;
  for (const JoinedColumn& column : columns) {
    const std::size_t table = table_of(column.place);
    if (table == clock_table_ || tables_[table].clock == ClockKind::kOwn) continue;
    if (const auto other = lookup.clock_of(column.place)) own(table, *other);
  }
}

LogJoin::LogJoin(const ImportMap& map, std::vector<OpenedLog>& logs, const ColumnLookup& lookup,
                 const std::vector<JoinedColumn>& columns, NoticeLog& log)
    : logs_(&logs), log_(&log), map_name_(map.name), ended_(logs.size(), false) {
  for (const JoinedColumn& column : columns) table_of(column.place);
  set_clock(map, lookup, columns);
  for (const JoinedColumn& column : columns) {
    Source source;
    source.table = table_of(column.place);
    source.kept = tables_[source.table].window.keep_column(column.place.column, column.bits);
    source.delay = column.delay;
    source.between = column.between;
    const bool other_clock =
        tables_[source.table].clock == ClockKind::kOwn && source.table != clock_table_;
    source.by_row = !other_clock && column.delay == 0;
    other_clocks_ = other_clocks_ || !source.by_row;
    sources_.push_back(source);
  }
}

const UnsignedWatch& LogJoin::watch(std::size_t column) const {
  const Source& source = sources_[column];
  return tables_[source.table].window.watch(source.kept);
}

bool LogJoin::pull(std::size_t log) {
  if (ended_[log]) return false;
  RawLog& raw = *(*logs_)[log].log;
  bool more = false;
  try {
    more = raw.next(rows_, kRowsAtOnce);
  } catch (const LogError& error) {
    throw RecordingError(error.what());
  }
  if (!more) {
    ended_[log] = true;
    return false;
  }
  std::size_t held = 0;
  for (Table& table : tables_) {
    if (table.log == log && table.table == rows_.table) table.window.append(rows_);
    held += table.window.held();
  }
  if (held > kMostHeld) {
    throw log_->error(0, 0,
                      fmt::format("found tables whose rows are so far apart that {} numbers wait "
                                  "for the others, expected tables that were recorded together "
                                  "(are the clocks the same, and the files of one run?)",
                                  held));
  }
  return true;
}

bool LogJoin::ensure(std::size_t table, std::size_t row) {
  while (tables_[table].window.end() <= row) {
    if (!pull(tables_[table].log)) return false;
  }
  if (tables_[table].clock == ClockKind::kOwn) count_from_base(tables_[table]);
  return true;
}

double LogJoin::time_of(std::size_t table, std::size_t row) const {
  if (rate_ > 0) return static_cast<double>(row) / rate_;
  const Table& clock =
      tables_[table].clock == ClockKind::kOwn ? tables_[table] : tables_[clock_table_];
  return clock.to_seconds(clock.window.value(row, clock.clock_column) - clock.first_raw) +
         clock.shift;
}

/// Zero of the join's time: that of the lead's clock, or of its first row if that is a calendar's.
/// @param place  of the first row that has a time
void LogJoin::set_base(std::uint64_t place) {
  Table& clock = tables_[clock_table_];
  const double raw = clock.window.value(row_, clock.clock_column);
  const std::optional<long double> origin = origin_seconds(clock);
  base_ = origin.value_or(0);
  const long double first = base_ + static_cast<long double>(clock.to_seconds(raw));
  if (std::abs(first) > kWallClock) {
    base_ = first;
    log_->add_once("wall clock", place, 0,
                   "times are those of a calendar; they are counted from the first row");
    if (!origin) clock_raw_ = raw;
  }
  base_known_ = true;
}

std::optional<long double> LogJoin::origin_seconds(const Table& table) const {
  // its column as the log numbers it
  const auto origin =
      (*logs_)[table.log].log->origin(table.table, table.window.columns()[table.clock_column]);
  if (!origin) return std::nullopt;
  return static_cast<long double>(origin->count) /
         static_cast<long double>(origin->counts_per_unit) *
         static_cast<long double>(table.to_seconds.factor) /
         static_cast<long double>(table.to_seconds.divisor);
}

/// What brings the times of a table to the zero of the join.
void LogJoin::count_from_base(Table& table) {
  if (table.counted || !base_known_) return;
  const std::optional<long double> origin = origin_seconds(table);
  if (!origin) table.first_raw = clock_raw_;
  const long double zero =
      origin ? *origin : static_cast<long double>(table.to_seconds(table.first_raw));
  table.shift = static_cast<double>(zero - base_);
  table.counted = true;
}

/// Learns the usual step of a table from its own rows, each step once: the median of those around a
/// row, of which a gap changes nothing.
void LogJoin::learn_step(std::size_t t, std::size_t row) {
  Table& table = tables_[t];
  const bool by_lead = table.clock == ClockKind::kOfLead && rate_ == 0;
  const std::size_t last = row + kStepsOfTable / 2;
  for (std::size_t at = std::max(row, table.steps_learnt); at < last; ++at) {
    if (!ensure(t, at + 1) || (by_lead && !ensure(clock_table_, at + 1))) break;
    const double step = time_of(t, at + 1) - time_of(t, at);
    if (step > 0) table.steps[table.step_count++ % kStepsOfTable] = step;
    table.steps_learnt = at + 1;
  }
  const auto count = static_cast<std::ptrdiff_t>(std::min(table.step_count, kStepsOfTable));
  if (count == 0) return;
  std::array<double, kStepsOfTable> steps = table.steps;
  std::nth_element(steps.begin(), steps.begin() + count / 2, steps.begin() + count);
  table.usual_step = steps[static_cast<std::size_t>(count / 2)];
}

/// The value of a source with a clock or a delay of its own.
LogJoin::Found LogJoin::interpolate(Source& source, double time, double& value) {
  const std::size_t t = source.table;
  Table& table = tables_[t];
  const double at = time + source.delay;
  const bool by_lead = table.clock == ClockKind::kOfLead && rate_ == 0;
  const auto there = [&](std::size_t row) {
    return ensure(t, row) && (!by_lead || ensure(clock_table_, row));
  };
  if (!there(source.cursor) || time_of(t, source.cursor) > at) return Found::kBefore;
  while (there(source.cursor + 1) && !(time_of(t, source.cursor + 1) > at)) ++source.cursor;
  const std::size_t row = source.cursor;
  const double t0 = time_of(t, row), x0 = table.window.value(row, source.kept);
  if (source.between == Between::kHold || t0 == at) {
    value = x0;
    return Found::kValue;
  }
  if (!there(row + 1)) return Found::kAfter;
  const double t1 = time_of(t, row + 1), x1 = table.window.value(row + 1, source.kept);
  const double step = t1 - t0;
  learn_step(t, row);
  if (step > kJoinGapSteps * table.usual_step) {
    value = kNoValue;
    return Found::kValue;
  }
  value = x0 + (x1 - x0) * (at - t0) / step;
  if (source.between == Between::kCubic && row > 0 && there(row + 2)) {
    const double before = time_of(t, row - 1), after = time_of(t, row + 2);
    const bool near = before < t0 && t0 - before <= kJoinGapSteps * table.usual_step &&
                      after > t1 && after - t1 <= kJoinGapSteps * table.usual_step;
    const double smooth = near ? cubic({before, t0, t1, after},
                                       {table.window.value(row - 1, source.kept), x0, x1,
                                        table.window.value(row + 2, source.kept)},
                                       at)
                               : kNoValue;
    if (std::isfinite(smooth)) value = smooth;
  }
  return Found::kValue;
}

/// Tables without a clock have as many rows as the lead.
void LogJoin::check_rows_end() {
  for (const Source& source : sources_) {
    if (!source.by_row) continue;
    if (!ensure(source.table, row_)) continue;
    const LogTable& longer =
        (*logs_)[tables_[source.table].log].log->tables()[tables_[source.table].table];
    throw log_->error(0, 0,
                      fmt::format("found {} rows where positions are and more in {}, expected as "
                                  "many, or a time column in each table",
                                  row_, runtime::quoted(longer.name)));
  }
}

void LogJoin::release() {
  for (Table& table : tables_) table.needed = row_;
  for (const Source& source : sources_) {
    if (source.by_row) continue;
    const std::size_t first = source.cursor > 0 ? source.cursor - 1 : 0;
    Table& table = tables_[source.table];
    // only own clocks run apart from the lead's rows
    const bool apart = table.clock == ClockKind::kOwn && source.table != clock_table_;
    table.needed = apart && !table.any_used ? first : std::min(table.needed, first);
    table.any_used = true;
    if (!apart && rate_ == 0) {
      tables_[clock_table_].needed = std::min(tables_[clock_table_].needed, first);
    }
  }
  for (Table& table : tables_) {
    table.any_used = false;
    table.window.release(table.needed);
  }
}

bool LogJoin::next(double& time, std::vector<double>& values, std::uint64_t& place) {
  values.resize(sources_.size());
  const std::size_t lead = sources_.front().table;
  for (;; ++row_) {
    if (!ensure(lead, row_)) {
      check_rows_end();
      return false;
    }
    place = tables_[lead].window.place(row_);
    if (rate_ == 0 && !ensure(clock_table_, row_)) {
      throw log_->error(place, 0,
                        fmt::format("found more rows than times, expected a time for each row "
                                    "(there are {})",
                                    row_));
    }
    if (rate_ == 0 && !base_known_) {
      Table& clock = tables_[clock_table_];
      if (!std::isfinite(clock.window.value(row_, clock.clock_column))) continue;
      set_base(place);
      count_from_base(clock);
    }
    time = time_of(lead, row_);
    if (other_clocks_) {
      if (!std::isfinite(time) || (any_row_ && time <= last_time_)) {
        log_->add("join backward", place, 0,
                  fmt::format("found time {} after {}, expected it to increase; the row is left "
                              "out, since other tables are joined by time",
                              time, last_time_));
        continue;
      }
      last_time_ = time;
      any_row_ = true;
    }
    bool covered = true;
    for (std::size_t i = 0; i < sources_.size(); ++i) {
      Source& source = sources_[i];
      if (source.by_row) {
        if (!ensure(source.table, row_)) {
          const Table& table = tables_[source.table];
          throw log_->error(
              place, 0,
              fmt::format("found {} rows in {} and more where positions are, expected as many, or "
                          "a time column in each table",
                          row_, runtime::quoted(std::string_view(name_of(table)))));
        }
        values[i] = tables_[source.table].window.value(row_, source.kept);
        continue;
      }
      const Found found = interpolate(source, time, values[i]);
      if (found == Found::kValue) continue;
      const Table& table = tables_[source.table];
      log_->add(found == Found::kBefore ? "join before" : "join after", place, 0,
                fmt::format("at {:.6g} s {} has {}; the row is left out", time,
                            runtime::quoted(std::string_view(name_of(table))),
                            found == Found::kBefore ? "not begun" : "ended"));
      covered = false;
      break;
    }
    release();
    if (!covered) continue;
    ++row_;
    return true;
  }
}

double LogJoin::fraction_read() const {
  double least = 1;
  for (const OpenedLog& one : *logs_) least = std::min(least, one.log->fraction_read());
  return least;
}

}  // namespace dyngen::runtime
