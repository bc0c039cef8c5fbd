// SPDX-License-Identifier: MIT
#include "runtime/import/imported_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>

#include "runtime/import/joint_transform.h"
#include "runtime/import/joint_units.h"
#include "runtime/import/log_join.h"
#include "runtime/recordings/row_parser.h"

namespace dyngen::runtime {
namespace {

/// Where the raw values of a signal stand in a row of the join, and what is made of them.
struct PlacedSignal {
  std::size_t first = 0, count = 0;  ///< columns of the join
  std::size_t target = 0;            ///< of the sample
  std::optional<JointTransform> transform;
};

/// Which rows are used: RunsMap.
class RowChoice {
 public:
  RowChoice(const RunsMap& runs, std::size_t split_first, std::size_t keep_first)
      : runs_(runs), split_(split_first), keep_(keep_first), last_(runs.split.names.size()) {}

  /// @return  why the row is left out; empty: it is used
  std::string judge(double time, const std::vector<double>& values) {
    if (!begun_) {
      begun_ = true;
      start_ = time;
    }
    bool changed = false;
    for (std::size_t i = 0; i < last_.size(); ++i) {
      const double value = values[split_ + i];
      changed = changed || (any_ && !same(value, last_[i]));
      last_[i] = value;
    }
    any_ = true;
    if (changed) ++segment_;
    std::string why = left_out(time, values);
    if (!why.empty()) {
      was_out_ = true;
    } else if (was_out_) {
      was_out_ = false;
      ++segment_;
    }
    return why;
  }
  [[nodiscard]] std::int64_t segment() const { return segment_; }

 private:
  static bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }
  [[nodiscard]] std::string left_out(double time, const std::vector<double>& values) const {
    for (std::size_t i = 0; i < runs_.keep.names.size(); ++i) {
      const double value = values[keep_ + i];
      if (value == 0 || std::isnan(value)) {
        return fmt::format("{} is not true", runtime::quoted(runs_.keep.names[i]));
      }
    }
    const double since = time - start_;
    if (runs_.skip_first > 0 && since < runs_.skip_first) {
      return fmt::format("it is of the first {} s (skip_first)", runs_.skip_first);
    }
    for (const auto& [from, to] : runs_.cuts) {
      if (since >= from && since <= to) {
        return fmt::format("it is cut out, from {} s to {} s", from, to);
      }
    }
    return {};
  }

  RunsMap runs_;
  std::size_t split_, keep_;
  std::vector<double> last_;
  bool begun_ = false, any_ = false, was_out_ = false;
  double start_ = 0;
  std::int64_t segment_ = 0;
};

class ImportedRows : public SampleSource {
 public:
  ImportedRows(const ImportMap& map, std::vector<OpenedLog> logs, const ImportedRobot& robot,
               NoticeLog& log);

  [[nodiscard]] const SampleLayout& layout() const override { return layout_; }
  [[nodiscard]] double fraction_read() const override { return join_->fraction_read(); }
  [[nodiscard]] std::size_t last_place() const override { return place_; }
  bool next(RowQueue& rows) override;

 private:
  void find_signals(const ColumnLookup& lookup);
  void choose_joints(const ColumnLookup& lookup);
  void drop_absent_slopes(const ColumnLookup& lookup);
  void check_list(const ColumnLookup& lookup) const;
  void add_signal(const ColumnLookup& lookup, const std::optional<SignalMap>& signal,
                  ColumnQuantity quantity, std::size_t& target);
  void add_columns(const std::vector<ColumnPlace>& columns, double delay, Between between,
                   int bits = 0);
  void tell_of_unsigned();
  void find_duty(const ColumnLookup& lookup);
  void tell_unit_conflicts(const SignalMap& signal, const std::vector<ColumnPlace>& columns);
  bool next_used(double& time, std::uint64_t& place);
  void tell_of_log(const std::string& path, const std::string& notice);
  void make(double time, std::uint64_t place, double* sample, RowInfo& info);

  ImportMap map_;
  std::vector<OpenedLog> logs_;
  std::vector<std::string> names_;
  std::vector<MotionKind> kinds_;
  NoticeLog* log_;
  std::size_t joints_ = 0;
  SampleLayout layout_;
  std::vector<JoinedColumn> columns_;
  std::vector<PlacedSignal> signals_;
  std::optional<DutyTransform> duty_;
  std::size_t duty_first_ = 0, voltage_first_ = 0, duty_target_ = 0, velocity_target_ = 0;
  std::optional<LogJoin> join_;
  std::optional<RowChoice> choice_;
  std::vector<double> values_, volts_;
  RowQueue waiting_{1};  ///< rows that are of the last seconds, if the log ends
  bool ended_ = false;
  std::size_t place_ = 0;
};

/// As many as the map says, the robot has, or the log has positions.
void ImportedRows::choose_joints(const ColumnLookup& lookup) {
  joints_ = static_cast<std::size_t>(map_.joints);
  if (joints_ == 0) joints_ = names_.size();
  const SignalMap& position = *map_.position;
  if (joints_ == 0) {
    joints_ =
        lookup
            .find_all(position.columns, position.file, position.table, 0, ColumnQuantity::kPosition)
            .size();
  }
  layout_.joints = static_cast<int>(joints_);
}

/// Velocities and accelerations of a motion follow from its positions where the log has none.
void ImportedRows::drop_absent_slopes(const ColumnLookup& lookup) {
  for (auto* signal : {&map_.velocity, &map_.acceleration}) {
    if (!*signal) continue;
    const auto quantity =
        signal == &map_.velocity ? ColumnQuantity::kVelocity : ColumnQuantity::kAcceleration;
    try {
      std::ignore =
          lookup.find_all((*signal)->columns, (*signal)->file, (*signal)->table, joints_, quantity);
    } catch (const ImportError&) {
      signal->reset();
    }
  }
}

/// Without a robot, a list that is too short would drop joints.
void ImportedRows::check_list(const ColumnLookup& lookup) const {
  const SignalMap& position = *map_.position;
  if (!map_.joints_by_a_list || !names_.empty() ||
      !is_column_pattern(position.columns.names.front())) {
    return;
  }
  const std::size_t columns =
      lookup.find_all(position.columns, position.file, position.table, 0, ColumnQuantity::kPosition)
          .size();
  if (columns <= joints_) return;
  throw ImportError(map_error(
      map_, map_.joints_place,
      fmt::format("found a list for {} joints, expected one for {}, as there are columns {}; or "
                  "'joints: {}' if the others are not wanted",
                  joints_, columns, runtime::quoted(position.columns.names.front()), joints_)));
}

void ImportedRows::add_columns(const std::vector<ColumnPlace>& columns, double delay,
                               Between between, int bits) {
  for (const ColumnPlace& column : columns) columns_.push_back({column, delay, between, bits});
}

void ImportedRows::tell_of_unsigned() {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const JoinedColumn& column = columns_[i];
    const UnsignedWatch& watch = join_->watch(i);
    if (column.bits > 0 || column.between == Between::kHold || watch.bits() == 0) continue;
    log_->add_once("unsigned " + column.place.name, 0, 0,
                   fmt::format("{} has whole numbers up to {:.0f} and none between {:.0f} and "
                               "{:.0f}: they look like signed numbers of {} bits; 'bits: {}' in "
                               "the map takes them as such",
                               runtime::quoted(column.place.name), watch.largest(),
                               std::ldexp(1.0, watch.bits() - 2),
                               3 * std::ldexp(1.0, watch.bits() - 2), watch.bits(), watch.bits()));
  }
}

void ImportedRows::tell_unit_conflicts(const SignalMap& signal,
                                       const std::vector<ColumnPlace>& columns) {
  for (std::size_t j = 0; j < columns.size() && !signal.units.empty(); ++j) {
    const std::string& unit = signal.units.size() == 1 ? signal.units.front() : signal.units[j];
    if (columns[j].unit.empty() || plain_unit(columns[j].unit) == plain_unit(unit)) continue;
    log_->add("unit conflict", 0, 0,
              fmt::format("the log says that {} is in {}, the map says {}: the map is followed",
                          runtime::quoted(columns[j].name), columns[j].unit, unit));
  }
}

void ImportedRows::add_signal(const ColumnLookup& lookup, const std::optional<SignalMap>& signal,
                              ColumnQuantity quantity, std::size_t& target) {
  if (!signal) return;
  const bool temperature = quantity == ColumnQuantity::kTemperature;
  if (signal->duty) {
    check_joint_units(map_, *signal, quantity, kinds_, {});
    target += joints_;
    return;
  }
  const std::vector<ColumnPlace> found =
      lookup.find_all(signal->columns, signal->file, signal->table,
                      temperature && !is_column_pattern(signal->columns.names.front())
                          ? signal->columns.names.size()
                      : temperature ? 0
                                    : joints_,
                      quantity);
  PlacedSignal placed;
  placed.first = columns_.size();
  placed.count = found.size();
  placed.target = target;
  if (!temperature) check_joint_units(map_, *signal, quantity, kinds_, found);
  placed.transform.emplace(map_, *signal, quantity, found, lookup);
  tell_unit_conflicts(*signal, found);
  add_columns(found, signal->delay,
              quantity == ColumnQuantity::kPosition ? Between::kCubic : Between::kLine,
              signal->bits);
  if (temperature) layout_.temperatures = static_cast<int>(found.size());
  target += found.size();
  signals_.push_back(std::move(placed));
}

void ImportedRows::find_duty(const ColumnLookup& lookup) {
  if (!map_.torque || !map_.torque->duty) return;
  const SignalMap& signal = *map_.torque;
  const DutyTorque& law = *signal.duty;
  duty_.emplace(map_, signal, joints_);
  duty_first_ = columns_.size();
  add_columns(
      lookup.find_all(law.duty, signal.file, signal.table, joints_, ColumnQuantity::kTorque),
      signal.delay, Between::kLine, signal.bits);
  voltage_first_ = columns_.size();
  if (law.voltage.names.empty()) return;
  ColumnNames names = law.voltage;
  if (names.names.size() == 1 && !is_column_pattern(names.names.front())) {
    names.names.assign(joints_, names.names.front());  // one supply for all
  }
  add_columns(lookup.find_all(names, signal.file, signal.table, joints_, ColumnQuantity::kTorque),
              signal.delay, Between::kLine);
}

void ImportedRows::find_signals(const ColumnLookup& lookup) {
  std::size_t target = 1;
  add_signal(lookup, map_.position, ColumnQuantity::kPosition, target);
  duty_target_ = target;
  add_signal(lookup, map_.torque, ColumnQuantity::kTorque, target);
  velocity_target_ = target;
  add_signal(lookup, map_.velocity, ColumnQuantity::kVelocity, target);
  add_signal(lookup, map_.acceleration, ColumnQuantity::kAcceleration, target);
  add_signal(lookup, map_.simulated_torque, ColumnQuantity::kTorque, target);
  add_signal(lookup, map_.link_position, ColumnQuantity::kPosition, target);
  add_signal(lookup, map_.temperature, ColumnQuantity::kTemperature, target);
  layout_.tau = map_.torque.has_value();
  layout_.dq = map_.velocity.has_value();
  layout_.ddq = map_.acceleration.has_value();
  layout_.tau_sim = map_.simulated_torque.has_value();
  for (std::size_t j = 0; map_.link_position && j < joints_; ++j) {
    layout_.links.push_back({static_cast<int>(j), 0, 0});
  }
  find_duty(lookup);
}

ImportedRows::ImportedRows(const ImportMap& map, std::vector<OpenedLog> logs,
                           const ImportedRobot& robot, NoticeLog& log)
    : map_(map), logs_(std::move(logs)), names_(robot.names), kinds_(robot.kinds), log_(&log) {
  if (!map_.joint_names.empty()) names_ = map_.joint_names;
  if (robot.joints > 0 && map_.joints > 0 && robot.joints != map_.joints) {
    throw ImportError(map_error(
        map_, map_.joints_place,
        fmt::format("found {} joints in the map, expected {} as the robot has (lists have one "
                    "entry for each)",
                    map_.joints, robot.joints)));
  }
  if (robot.joints > 0) map_.joints = robot.joints;
  const ColumnLookup lookup(map_, logs_, names_);
  choose_joints(lookup);
  if (robot.joints == 0) check_list(lookup);
  if (map_.motion_only) drop_absent_slopes(lookup);
  find_signals(lookup);
  const RunsMap& runs = map_.runs;
  const std::size_t split = columns_.size();
  const auto flags = [&](const ColumnNames& names) {
    if (names.names.empty()) return;
    add_columns(lookup.find_all(names, runs.file, runs.table, names.names.size(),
                                ColumnQuantity::kPosition),
                0, Between::kHold);
  };
  flags(runs.split);
  const std::size_t keep = columns_.size();
  flags(runs.keep);
  choice_.emplace(runs, split, keep);
  join_.emplace(map_, logs_, lookup, columns_, log);
  waiting_ = RowQueue(layout_.width());
  volts_.resize(joints_);
}

/// A line of a log's own, "FILE:line:column: warning: message", as a notice.
void ImportedRows::tell_of_log(const std::string& path, const std::string& notice) {
  constexpr std::string_view kMark = ": warning: ";
  const std::size_t mark = notice.find(kMark);
  if (mark == std::string::npos || !notice.starts_with(path)) {
    log_->add_once(notice, 0, 0, notice);
    return;
  }
  std::size_t line = 0, column = 0;
  const char* end = notice.data() + mark;
  const char* at = notice.data() + path.size();
  for (std::size_t* number : {&line, &column}) {
    if (at == end || *at != ':') break;
    at = std::from_chars(at + 1, end, *number).ptr;
  }
  log_->add_once(notice, line, column, notice.substr(mark + kMark.size()));
}

/// The next row that is used, in values_.
bool ImportedRows::next_used(double& time, std::uint64_t& place) {
  while (join_->next(time, values_, place)) {
    place_ = static_cast<std::size_t>(place);
    const std::string why = choice_->judge(time, values_);
    if (why.empty()) return true;
    log_->add("chosen " + why, place_, 0, fmt::format("the row is left out: {}", why));
  }
  tell_of_unsigned();
  for (const OpenedLog& one : logs_) {
    for (const std::string& notice : one.log->notices()) tell_of_log(one.path, notice);
  }
  return false;
}

void ImportedRows::make(double time, std::uint64_t place, double* sample, RowInfo& info) {
  constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
  info = RowInfo();
  info.line = static_cast<std::size_t>(place);
  info.segment = choice_->segment();
  sample[0] = std::abs(time) <= kWildTime ? time : kMissing;
  for (const PlacedSignal& signal : signals_) {
    signal.transform->apply(values_.data() + signal.first, sample + signal.target);
  }
  if (duty_) {
    const DutyTorque& law = *map_.torque->duty;
    for (std::size_t j = 0; j < joints_; ++j) {
      volts_[j] =
          law.voltage.names.empty() ? of_joint(law.supply, j, 0) : values_[voltage_first_ + j];
    }
    duty_->apply(values_.data() + duty_first_, volts_.data(), sample + velocity_target_,
                 sample + duty_target_);
  }
  bool bad = std::isnan(sample[0]);
  const std::size_t first_temperature =
      layout_.width() - static_cast<std::size_t>(layout_.temperatures);
  for (std::size_t i = 1; i < layout_.width(); ++i) {
    if (!(std::abs(sample[i]) <= kWildValue)) {
      sample[i] = kMissing;
      bad = bad || i < first_temperature;  // a missing temperature makes no row bad
    }
  }
  if (!bad) return;
  info.bad_column = 1;
  info.bad_word = std::isnan(sample[0]) ? "no time" : "a value that is too large";
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!std::isnan(values_[i])) continue;
    info.bad_word = "nothing in " + columns_[i].place.name;
    break;
  }
}

bool ImportedRows::next(RowQueue& rows) {
  double time = 0;
  std::uint64_t place = 0;
  const double last = map_.runs.skip_last;
  if (last == 0) {
    if (!next_used(time, place)) return false;
    rows.add();
    make(time, place, rows.values(rows.size() - 1), rows.info(rows.size() - 1));
    return true;
  }
  while (!ended_ &&
         (waiting_.empty() || !(waiting_.time(waiting_.size() - 1) - waiting_.time(0) > last))) {
    if (!next_used(time, place)) {
      ended_ = true;
      break;
    }
    waiting_.add();
    make(time, place, waiting_.values(waiting_.size() - 1), waiting_.info(waiting_.size() - 1));
  }
  if (ended_) {
    for (std::size_t i = 0; i < waiting_.size(); ++i) {
      log_->add("skip last", waiting_.info(i).line, 0,
                fmt::format("the row is left out: it is of the last {} s (skip_last)", last));
    }
    waiting_.clear();
    return false;
  }
  rows.push(waiting_.values(0), waiting_.info(0));
  waiting_.pop_front();
  return true;
}

}  // namespace

std::unique_ptr<SampleSource> imported_rows(const ImportMap& map, std::vector<OpenedLog> logs,
                                            const ImportedRobot& robot, NoticeLog& log) {
  return std::make_unique<ImportedRows>(map, std::move(logs), robot, log);
}

}  // namespace dyngen::runtime
