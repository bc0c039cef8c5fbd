// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
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
  /// @throws RecordingError if more than 5 % of all rows (and more than a dozen) are bad one by
  /// one,
  ///         or more than half stand in blocks that were left out
  void finish();

 private:
  void push_good(const double* values, const RowInfo& info);
  void count_block();
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
  std::size_t rows_ = 0;
  struct Count {
    std::size_t rows = 0;
    RowInfo first;
  };
  Count scattered_, in_blocks_;
};

}  // namespace dyngen::runtime
