// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/recordings/notice_log.h"
#include "runtime/recordings/row_queue.h"
#include "runtime/recordings/row_repair.h"

namespace dyngen::runtime {

/// Makes time increase within a run: drops rows that stand twice or out of order, begins a new run
/// where time starts again or leaves a gap. Looks kLookAhead rows ahead.
class TimeRepair {
 public:
  static constexpr std::size_t kLookAhead = 32;
  /// Rows that share a stamp are at most so many: seconds of a log at 4 kHz.
  static constexpr std::size_t kLargestGroup = 4096;
  /// No gap is shorter than this many usual steps; a gap of kLongGap seconds is one in any case.
  static constexpr double kGapSteps = 5, kLongGap = 1.5;
  /// A step back of more usual steps than this is a new start.
  static constexpr double kRestartSteps = 10;
  /// A usual step above this is hardly meant in seconds.
  static constexpr double kSlowStep = 0.5;

  /// @param spread_stamps  rows that share a stamp are spread evenly up to the next one, not left
  /// out
  TimeRepair(std::size_t width, BadValueRepair& next, NoticeLog& log, bool spread_stamps = false);
  /// Takes the row that the caller has put last into queue().
  void pushed();
  void finish();
  [[nodiscard]] RowQueue& queue() { return ahead_; }

 private:
  void process_front();
  [[nodiscard]] double usual_stamp_step() const;
  void spread_front();
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
  bool spread_stamps_;
  RowQueue ahead_;
  std::vector<double> last_;  ///< values of the last row accepted, as they were
  bool in_run_ = false;
  bool step_noticed_ = false;
  std::int64_t segment_ = 0;
  double run_begin_ = 0, last_time_ = 0;
  std::size_t untimed_ = 0;              ///< rows with a bad time since last_time_
  double usual_step_ = 0;                ///< s; infinite if unknown
  std::array<double, 8> stamp_steps_{};  ///< s, of the last groups of rows that share a stamp
  std::size_t stamp_step_count_ = 0;
  std::size_t rows_spread_ = 0;  ///< at the front, whose times are their own now
  double spacing_ = 0;           ///< s, of the rows of the last group
  std::array<double, kLookAhead> steps_{};
  std::size_t step_count_ = 0;
};

}  // namespace dyngen::runtime
