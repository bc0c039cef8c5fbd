// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/recordings/notice_log.h"
#include "runtime/recordings/row_queue.h"

namespace dyngen::runtime {

/// A run must be this long; a shorter one says nothing about derivatives.
inline constexpr std::size_t kShortestRun = 8;
/// As many bad rows in succession are interpolated; more split the run.
inline constexpr std::size_t kLongestRepair = 10;

/// Keeps runs of at least kShortestRun rows (or the only run, if it has two).
class ShortRunFilter {
 public:
  ShortRunFilter(std::size_t width, RowQueue& out, NoticeLog& log);
  void push(const double* values, const RowInfo& info, bool starts_run);
  void finish();

 private:
  void end_run(bool is_last);
  void emit(const double* values, const RowInfo& info);

  RowQueue* out_;
  NoticeLog* log_;
  RowQueue held_;  ///< the first rows of a run that is not long enough yet
  bool long_enough_ = false;
  bool next_starts_run_ = true;
  bool any_kept_ = false, any_dropped_ = false;
};

/// Puts numbers in for bad values: linear in time between the good neighbours of the same column.
class BadValueRepair {
 public:
  BadValueRepair(std::size_t width, ShortRunFilter& next, NoticeLog& log);
  void push(const double* values, const RowInfo& info, bool starts_run);
  /// @throws RecordingError if more than 1 % of all rows (and more than a dozen) were bad
  void finish();

 private:
  void push_good(const double* values, const RowInfo& info);
  void drop_block(const char* why);
  void interpolate(const double* after);
  void emit(const double* values, const RowInfo& info);

  std::size_t width_;
  ShortRunFilter* next_;
  NoticeLog* log_;
  RowQueue block_;  ///< bad rows that wait for a good one
  std::vector<double> last_good_;
  bool has_good_ = false;  ///< last_good_ is of this run
  bool too_long_ = false;  ///< the block was given up
  bool next_starts_run_ = true;
  std::size_t rows_ = 0, bad_rows_ = 0;
  RowInfo first_bad_;
};

/// Makes time increase within a run: drops rows that stand twice or out of order, begins a new run
/// where time starts again or leaves a gap. Looks kLookAhead rows ahead.
class TimeRepair {
 public:
  static constexpr std::size_t kLookAhead = 32;
  /// No gap is shorter than this many usual steps; a gap of kLongGap seconds is one in any case.
  static constexpr double kGapSteps = 5, kLongGap = 1.5;
  /// A step back of more usual steps than this is a new start.
  static constexpr double kRestartSteps = 10;
  /// A usual step above this is hardly meant in seconds.
  static constexpr double kSlowStep = 0.5;

  TimeRepair(std::size_t width, BadValueRepair& next, NoticeLog& log);
  /// Takes the row that the caller has put last into queue().
  void pushed();
  void finish();
  [[nodiscard]] RowQueue& queue() { return ahead_; }

 private:
  void process_front();
  void process_backward(double step);
  void begin_run(const char* why);
  void accept(bool starts_run);
  [[nodiscard]] bool next_row_fits(double limit) const;
  [[nodiscard]] double gap_limit() const;
  void estimate_step();
  void learn_step(double step);
  void drop(const char* kind, const std::string& message);

  std::size_t width_;
  BadValueRepair* next_;
  NoticeLog* log_;
  RowQueue ahead_;
  std::vector<double> last_;  ///< values of the last row accepted, as they were
  bool in_run_ = false;
  bool step_noticed_ = false;
  std::int64_t segment_ = 0;
  double run_begin_ = 0, last_time_ = 0;
  std::size_t untimed_ = 0;  ///< rows with a bad time since last_time_
  double usual_step_ = 0;    ///< s; infinite if unknown
  std::array<double, kLookAhead> steps_{};
  std::size_t step_count_ = 0;
};

}  // namespace dyngen::runtime
