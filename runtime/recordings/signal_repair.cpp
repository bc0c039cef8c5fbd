// SPDX-License-Identifier: MIT
#include "runtime/recordings/signal_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "runtime/recordings/glitches.h"
#include "runtime/recordings/held_columns.h"
#include "runtime/recordings/jumps.h"
#include "runtime/recordings/link_encoders.h"
#include "runtime/recordings/notice_log.h"
#include "runtime/recordings/row_repair.h"
#include "runtime/recordings/stuck_columns.h"
#include "runtime/recordings/temperature_repair.h"
#include "runtime/recordings/time_base.h"
#include "runtime/recordings/unwrapping.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr std::size_t kFewGlitches = 12;
constexpr double kMostGlitches = 0.05;  // of the rows

double quantile_between(std::vector<double> values, double part) {
  if (values.empty()) return 0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Range of a column without its extreme values.
double usual_range(const Eigen::Ref<const Eigen::VectorXd>& column) {
  constexpr double kTail = 0.005;
  std::vector<double> values(column.begin(), column.end());
  return quantile_between(values, 1 - kTail) - quantile_between(values, kTail);
}

/// Repairs a recording in memory and collects what is told.
class SignalRepair {
 public:
  SignalRepair(Recording& recording, std::vector<Notice>& notices)
      : recording_(recording),
        notices_(notices),
        left_out_(static_cast<std::size_t>(recording.samples()), false) {
    sample_time_ = examine_time_base(recording).sample_time;
  }

  void run() {
    if (recording_.samples() == 0) return;
    repair_temperatures(recording_, notices_);
    for (Index j = 0; j < positions(); ++j) {
      if (j < recording_.q.cols() || recording_.has_link(j - recording_.q.cols())) {
        repair_position(j);
      }
    }
    for (Index j = 0; j < recording_.tau.cols(); ++j) {
      repair_held("tau", recording_.tau, j);
      repair_torque(j);
    }
    for (Index j = 0; j < recording_.dq.cols(); ++j) repair_held("qd", recording_.dq, j);
    for (Index j = 0; j < recording_.ddq.cols(); ++j) repair_held("qdd", recording_.ddq, j);
    judge_jumps();
    take_out();
    check_link_encoders(recording_, notices_);
  }

 private:
  [[nodiscard]] std::size_t line(Index row) const {
    return recording_.lines.empty() ? 0 : recording_.lines[static_cast<std::size_t>(row)];
  }
  [[nodiscard]] std::size_t runs() const { return recording_.run_starts.size(); }
  [[nodiscard]] Index first(std::size_t run) const { return recording_.run_starts[run]; }
  [[nodiscard]] Index count(std::size_t run) const { return run_end(recording_, run) - first(run); }

  /// Positions of the joints, then those behind their gears.
  [[nodiscard]] Index positions() const { return recording_.q.cols() + recording_.q_link.cols(); }
  [[nodiscard]] auto position(Index j) {
    return j < recording_.q.cols() ? recording_.q.col(j)
                                   : recording_.q_link.col(j - recording_.q.cols());
  }
  [[nodiscard]] std::string position_name(Index j) const {
    const Index n = recording_.q.cols();
    return j < n ? fmt::format("q{}", j + 1) : fmt::format("ql{}", j - n + 1);
  }

  void tell(Index row, const std::string& message) {
    notices_.push_back({recording_.file_name, line(row), 0, message, recording_.place_word});
  }

  /// A step that is small for the column; of a coarse encoder, its count.
  [[nodiscard]] double resolution(Index column) {
    const auto values = position(column);
    std::vector<double> steps;
    for (std::size_t run = 0; run < runs(); ++run) {
      for (Index k = first(run) + 1; k < first(run) + count(run); ++k) {
        const double step = std::abs(values(k) - values(k - 1));
        if (step > 0) steps.push_back(step);
      }
    }
    constexpr double kSmall = 0.1;
    return quantile_between(std::move(steps), kSmall);
  }

  void repair_position(Index j) {
    const Unwrapping turns = unwrap(recording_, position(j));
    if (turns.count > 0) {
      tell(turns.row,
           fmt::format("{} jumps by a whole turn, from {:.6g} to {:.6g}; unwrapped{}",
                       position_name(j), turns.before, turns.after, times_in_all(turns.count)));
    }
    const double small = resolution(j);
    std::vector<Glitch> glitches;
    std::vector<Stuck> stuck;
    for (std::size_t run = 0; run < runs(); ++run) {
      const auto time = recording_.time.segment(first(run), count(run));
      auto own = position(j).segment(first(run), count(run));
      append(glitches, repair_position_glitches(time, own, sample_time_, small), run);
      append(stuck, find_frozen_positions(time, own, sample_time_, small), run);
      for (const Jump& jump : find_jumps(time, own, sample_time_, small)) {
        jumps_[first(run) + jump.row].push_back({j, run, jump});
      }
    }
    tell_glitches(position_name(j), position(j), glitches);
    tell_stuck(fmt::format("{} freezes while the joint moves", position_name(j)), stuck);
  }

  void repair_torque(Index j) {
    const double range = usual_range(recording_.tau.col(j));
    const double moved = usual_range(recording_.q.col(j)) / 100;
    std::vector<Glitch> glitches;
    std::vector<Stuck> stuck;
    for (std::size_t run = 0; run < runs(); ++run) {
      const auto time = recording_.time.segment(first(run), count(run));
      const auto position = recording_.q.col(j).segment(first(run), count(run));
      const auto torque = recording_.tau.col(j).segment(first(run), count(run));
      append(glitches, repair_torque_glitches(time, torque, range), run);
      if (moved > 0) append(stuck, find_stuck_torques(time, position, torque, moved), run);
    }
    tell_glitches(fmt::format("tau{}", j + 1), recording_.tau.col(j), glitches);
    tell_stuck(fmt::format("tau{} is one number while the joint moves", j + 1), stuck);
  }

  /// A column that is slower than the rows: zeros or repetitions between its values.
  void repair_held(const char* name, Eigen::MatrixXd& matrix, Index j) {
    std::size_t longest = 0;
    for (std::size_t run = 1; run < runs(); ++run) {
      if (count(run) > count(longest)) longest = run;
    }
    const HeldColumn held = find_held(matrix.col(j).segment(first(longest), count(longest)));
    if (held.period < 2) return;
    for (std::size_t run = 0; run < runs(); ++run) {
      fill_held(recording_.time.segment(first(run), count(run)), held,
                matrix.col(j).segment(first(run), count(run)));
    }
    tell(first(longest),
         held.pulsed
             ? fmt::format("{}{} has a value every {} samples only, and 0 between them: its source "
                           "is slower; interpolated between the values",
                           name, j + 1, held.period)
             : fmt::format("{}{} changes every {} samples only, and is held between: its source "
                           "is slower; interpolated between the changes",
                           name, j + 1, held.period));
  }

  static std::string times_in_all(Index count) {
    return count > 1 ? fmt::format(" ({} such jumps in all)", count) : std::string();
  }

  /// Rows of a run become those of the recording; those that are left out are marked.
  void append(std::vector<Glitch>& all, std::vector<Glitch> more, std::size_t run) {
    for (Glitch& glitch : more) {
      glitch.first += first(run);
      if (glitch.at_end) mark(glitch.first, glitch.count);
      all.push_back(glitch);
    }
  }
  void append(std::vector<Stuck>& all, std::vector<Stuck> more, std::size_t run) {
    for (Stuck& stuck : more) {
      stuck.first += first(run);
      mark(stuck.first, stuck.count);
      all.push_back(stuck);
    }
  }
  void mark(Index row, Index rows) { std::fill_n(left_out_.begin() + row, rows, true); }

  void tell_glitches(const std::string& name, const Eigen::Ref<const Eigen::VectorXd>& values,
                     const std::vector<Glitch>& glitches) {
    if (glitches.empty()) return;
    std::size_t samples = 0;
    for (const Glitch& glitch : glitches) samples += static_cast<std::size_t>(glitch.count);
    const Glitch& one = glitches.front();
    if (samples > kFewGlitches &&
        static_cast<double>(samples) > kMostGlitches * static_cast<double>(values.size())) {
      throw recording_error(
          recording_.file_name, line(one.first), 0,
          fmt::format("found {:.6g} in {}, the first of {} samples of {} that stand off their "
                      "neighbours, expected at most {} %: mend the sensor or its cable, or filter "
                      "the column, and record it again",
                      one.value, name, samples, values.size(), 100 * kMostGlitches));
    }
    std::string message = fmt::format("{} is {:.6g}", name, one.value);
    if (one.at_end) {
      message += fmt::format(", far from the samples of its run; {}", left_out(one.count));
    } else {
      message += fmt::format(
          " between {:.6g} and {:.6g}; {}", values(one.first - 1), values(one.first + one.count),
          one.count == 1 ? "interpolated" : fmt::format("{} samples interpolated", one.count));
    }
    if (glitches.size() > 1) {
      message += fmt::format(" ({} such in all, the last in {} {})", glitches.size(),
                             recording_.place_word, line(glitches.back().first));
    }
    tell(one.first, message);
  }

  [[nodiscard]] bool splits(Index row) const {
    return std::binary_search(splits_.begin(), splits_.end(), row);
  }

  static std::string left_out(Index rows) {
    return rows == 1 ? "the row is left out" : fmt::format("{} rows are left out", rows);
  }

  void tell_stuck(const std::string& what, const std::vector<Stuck>& stuck) {
    if (stuck.empty()) return;
    Index rows = 0;
    for (const Stuck& one : stuck) rows += one.count;
    const Stuck& one = stuck.front();
    const double duration =
        recording_.time(one.first + one.count - 1) - recording_.time(one.first - 1);
    std::string message = fmt::format("{}: {:.3g} s; {}, and a new run begins after them", what,
                                      duration, left_out(one.count));
    if (stuck.size() > 1) {
      message += fmt::format(" ({} such in all with {} rows, the last in {} {})", stuck.size(),
                             rows, recording_.place_word, line(stuck.back().first));
    }
    tell(one.first, message);
    first_stuck_ = std::min(first_stuck_, line(one.first));
  }

  void judge_jumps();
  void take_out();

  struct JumpOfJoint {
    Index joint = 0;  ///< place among the positions
    std::size_t run = 0;
    Jump jump;
  };

  Recording& recording_;
  std::vector<Notice>& notices_;
  std::vector<bool> left_out_;
  std::map<Index, std::vector<JumpOfJoint>> jumps_;  ///< by row
  std::vector<Index> splits_;                        ///< rows before which a run ends, increasing
  double sample_time_ = 0;
  std::size_t first_stuck_ = static_cast<std::size_t>(-1);
};

/// Several joints that jump at once, or one that jumps along its way, say that rows are missing. A
/// joint that jumps alone and back was off between; one that does not come back has lost its zero.
void SignalRepair::judge_jumps() {
  constexpr double kMissingRows = 50;
  std::vector<std::vector<std::pair<Index, JumpOfJoint>>> alone(
      static_cast<std::size_t>(positions()));
  for (const auto& [row, jumps] : jumps_) {
    if (left_out_[static_cast<std::size_t>(row - 1)]) continue;  // after what was stuck
    const JumpOfJoint& one = jumps.front();
    if (jumps.size() == 1 && !(one.jump.steps >= 0 && one.jump.steps <= kMissingRows)) {
      alone[static_cast<std::size_t>(one.joint)].emplace_back(row, one);
      continue;
    }
    if (splits_.empty()) {
      tell(row, fmt::format("{} jumps from {:.6g} to {:.6g} as if rows were missing; a new run "
                            "begins here, and at each such jump",
                            position_name(one.joint), position(one.joint)(row - 1),
                            position(one.joint)(row)));
    }
    splits_.push_back(row);
  }
  for (const auto& jumps : alone) {
    for (std::size_t i = 0; i < jumps.size(); i += 2) {  // a jump, and the one back
      constexpr double kBack = 0.2, kMostOff = 0.2;
      const auto& [row, one] = jumps[i];
      const Index end = i + 1 < jumps.size() ? jumps[i + 1].first : row;
      const bool comes_back =
          i + 1 < jumps.size() && jumps[i + 1].second.run == one.run &&
          std::abs(one.jump.size + jumps[i + 1].second.jump.size) <=
              kBack * std::abs(one.jump.size) &&
          static_cast<double>(end - row) <= kMostOff * static_cast<double>(recording_.samples());
      if (!comes_back) {
        throw recording_error(
            recording_.file_name, line(row), 0,
            fmt::format("found {} at {:.6g} after {:.6g}, from where it goes on, expected no jump: "
                        "was its zero lost? Leave out the rows on one side",
                        position_name(one.joint), position(one.joint)(row),
                        position(one.joint)(row - 1)));
      }
      tell(row,
           fmt::format("{} is off by {:.4g} for {} samples, and comes back; {}, and a new run "
                       "begins after them",
                       position_name(one.joint), one.jump.size, end - row, left_out(end - row)));
      mark(row, end - row);
    }
  }
}

/// Takes out the rows that are marked, splits runs there, and leaves out what is too short then.
void SignalRepair::take_out() {
  const auto marked = std::count(left_out_.begin(), left_out_.end(), true);
  if (marked == 0 && splits_.empty()) return;
  const auto refuse = [&](const std::string& message) {
    const std::size_t place = first_stuck_ == static_cast<std::size_t>(-1) ? 0 : first_stuck_;
    throw recording_error(recording_.file_name, place, 0, message);
  };
  if (2 * marked > recording_.samples()) {
    refuse(
        fmt::format("found {} rows of {} in which a column is stuck, expected at most half: "
                    "record it again, all columns with one sample time",
                    marked, recording_.samples()));
  }
  std::vector<Index> kept, run_starts;
  for (std::size_t run = 0; run < runs(); ++run) {
    const Index end = first(run) + count(run);
    for (Index from = first(run); from < end;) {
      Index to = from;
      while (to < end && !left_out_[static_cast<std::size_t>(to)] && (to == from || !splits(to))) {
        ++to;
      }
      const bool whole = from == first(run) && to == end;
      if (whole || to - from >= static_cast<Index>(kShortestRun)) {
        run_starts.push_back(static_cast<Index>(kept.size()));
        for (Index k = from; k < to; ++k) kept.push_back(k);
      }
      from = to < end && left_out_[static_cast<std::size_t>(to)] ? to + 1 : to;
    }
  }
  if (kept.empty()) refuse("found no run that is left where no column is stuck");
  recording_.time = recording_.time(kept).eval();
  for (const auto part : kRecordingParts) {
    Eigen::MatrixXd& matrix = recording_.*part;
    if (matrix.cols() > 0) matrix = matrix(kept, Eigen::all).eval();
  }
  if (!recording_.lines.empty()) {
    std::vector<std::uint32_t> lines;
    lines.reserve(kept.size());
    for (const Index k : kept) lines.push_back(recording_.lines[static_cast<std::size_t>(k)]);
    recording_.lines = std::move(lines);
  }
  recording_.run_starts = std::move(run_starts);
}

}  // namespace

void repair_signals(Recording& recording, std::vector<Notice>& notices) {
  SignalRepair(recording, notices).run();
}

}  // namespace dyngen::runtime
