// SPDX-License-Identifier: MIT
#include "runtime/recordings/row_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {

ShortRunFilter::ShortRunFilter(std::size_t width, RowQueue& out, NoticeLog& log)
    : out_(&out), log_(&log), held_(width) {}

void ShortRunFilter::emit(const double* values, const RowInfo& info) {
  out_->push(values, info);
  out_->info(out_->size() - 1).starts_run = next_starts_run_;
  next_starts_run_ = false;
  any_kept_ = true;
}

void ShortRunFilter::push(const double* values, const RowInfo& info, bool starts_run) {
  if (starts_run) {
    end_run(false);
    long_enough_ = false;
    next_starts_run_ = true;
  }
  if (long_enough_) {
    emit(values, info);
    return;
  }
  held_.push(values, info);
  if (held_.size() < kShortestRun) return;
  long_enough_ = true;
  for (std::size_t i = 0; i < held_.size(); ++i) emit(held_.values(i), held_.info(i));
  held_.clear();
}

void ShortRunFilter::end_run(bool is_last) {
  if (held_.empty()) return;
  const std::size_t count = held_.size();
  const std::size_t line = held_.info(0).line;
  if (is_last && !any_kept_ && !any_dropped_ && count >= 2) {
    log_->add("few samples", line, 0,
              fmt::format("found {} samples in all; kept, but derivatives need more", count));
    for (std::size_t i = 0; i < count; ++i) emit(held_.values(i), held_.info(i));
  } else {
    log_->add("short run", line, 0,
              fmt::format("found a run of {} sample{}, expected {} or more; left out", count,
                          count == 1 ? "" : "s", kShortestRun));
    any_dropped_ = true;
  }
  held_.clear();
}

void ShortRunFilter::finish() { end_run(true); }

BadValueRepair::BadValueRepair(std::size_t width, ShortRunFilter& next, NoticeLog& log)
    : width_(width), next_(&next), log_(&log), block_(width), last_good_(width) {}

void BadValueRepair::emit(const double* values, const RowInfo& info) {
  next_->push(values, info, next_starts_run_);
  next_starts_run_ = false;
}

void BadValueRepair::drop_block(const char* why) {
  if (block_.empty()) return;
  for (std::size_t i = 0; i < block_.size(); ++i) {
    const RowInfo& info = block_.info(i);
    log_->add(why, info.line, info.bad_column,
              fmt::format("found {}, expected a number of at most 1e9; the row is left out ({})",
                          info.bad_word, why));
  }
  block_.clear();
}

void BadValueRepair::push(const double* values, const RowInfo& info, bool starts_run) {
  ++rows_;
  if (starts_run) {
    count_block();
    drop_block("no good row follows in its run");
    has_good_ = false;
    too_long_ = false;
    next_starts_run_ = true;
  }
  if (!info.bad()) {
    push_good(values, info);
    return;
  }
  if (too_long_) {
    ++in_blocks_.rows;
    return;
  }
  block_.push(values, info);
  if (block_.size() > kLongestRepair) {
    if (in_blocks_.rows == 0) in_blocks_.first = block_.info(0);
    in_blocks_.rows += block_.size();
    log_->add(
        "long block", block_.info(0).line, block_.info(0).bad_column,
        fmt::format("found {}, and more than {} bad rows in succession; they are left out, and "
                    "a new run begins after them",
                    block_.info(0).bad_word, kLongestRepair));
    block_.clear();
    too_long_ = true;
  }
}

void BadValueRepair::count_block() {
  if (block_.empty()) return;
  if (scattered_.rows == 0) scattered_.first = block_.info(0);
  scattered_.rows += block_.size();
}

void BadValueRepair::push_good(const double* values, const RowInfo& info) {
  count_block();
  if (too_long_) {
    too_long_ = false;
    next_starts_run_ = true;
  } else if (!block_.empty() && !has_good_) {
    drop_block("no good row stands before it in its run");
  } else if (!block_.empty()) {
    interpolate(values);
    for (std::size_t i = 0; i < block_.size(); ++i) {
      const RowInfo& bad = block_.info(i);
      log_->add("interpolated", bad.line, bad.bad_column,
                fmt::format("found {}, expected a number of at most 1e9; interpolated between its "
                            "neighbours",
                            bad.bad_word));
      emit(block_.values(i), bad);
    }
    block_.clear();
  }
  emit(values, info);
  std::copy(values, values + width_, last_good_.begin());
  has_good_ = true;
}

/// Fills the NaN of the block, which stands between last_good_ and `after`.
void BadValueRepair::interpolate(const double* after) {
  const std::size_t count = block_.size();
  const auto at = [&](std::size_t row) -> const double* {  // 0: last_good_, count + 1: after
    if (row == 0) return last_good_.data();
    return row == count + 1 ? after : block_.values(row - 1);
  };
  for (std::size_t column = 0; column < width_; ++column) {
    if (std::isnan(after[column])) continue;  // a temperature, which good rows may lack
    for (std::size_t row = 1; row <= count; ++row) {
      if (!std::isnan(at(row)[column])) continue;
      std::size_t right = row + 1;
      while (std::isnan(at(right)[column])) ++right;
      // Time itself (column 0, filled first) is taken to be uniform.
      const double left_time = column == 0 ? static_cast<double>(row - 1) : at(row - 1)[0];
      const double right_time = column == 0 ? static_cast<double>(right) : at(right)[0];
      const double time = column == 0 ? static_cast<double>(row) : at(row)[0];
      const double share = (time - left_time) / (right_time - left_time);
      const double left_value = at(row - 1)[column];
      block_.values(row - 1)[column] = left_value + share * (at(right)[column] - left_value);
    }
  }
}

void BadValueRepair::finish() {
  count_block();
  drop_block("no good row follows in its run");
  constexpr std::size_t kFewBadRows = 12, kMostPerCent = 5;
  if (scattered_.rows > kFewBadRows && 100 * scattered_.rows > kMostPerCent * rows_) {
    throw log_->error(
        scattered_.first.line, scattered_.first.bad_column,
        fmt::format("found {}, the first of {} bad rows here and there in {}, expected at most {} "
                    "% of the rows to miss a value or to have one beyond 1e9: delete these rows if "
                    "the rest is to be used",
                    scattered_.first.bad_word, scattered_.rows, rows_, kMostPerCent));
  }
  if (2 * in_blocks_.rows > rows_) {
    throw log_->error(
        in_blocks_.first.line, in_blocks_.first.bad_column,
        fmt::format("found {}, the first of {} bad rows of {} in blocks, expected at most half of "
                    "the rows to miss a value or to have one beyond 1e9: was this column "
                    "recorded?",
                    in_blocks_.first.bad_word, in_blocks_.rows, rows_));
  }
}

}  // namespace dyngen::runtime
