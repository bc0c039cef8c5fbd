// SPDX-License-Identifier: MIT
#include "runtime/recordings/time_repair.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dyngen::runtime {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

/// Of values[0, count), which it reorders; kUnknown of none.
double median(std::array<double, TimeRepair::kLookAhead>& values, std::size_t count) {
  if (count == 0) return kUnknown;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
  return *middle;
}

}  // namespace

TimeRepair::TimeRepair(std::size_t width, BadValueRepair& next, NoticeLog& log, bool spread_stamps)
    : width_(width),
      next_(&next),
      log_(&log),
      spread_stamps_(spread_stamps),
      ahead_(width),
      last_(width) {}

/// Steps from stamp to stamp of what lies ahead and of the groups before it: their median.
double TimeRepair::usual_stamp_step() const {
  std::array<double, kLookAhead> steps{};
  std::size_t count = std::min(stamp_step_count_, stamp_steps_.size());
  std::copy_n(stamp_steps_.begin(), count, steps.begin());
  for (std::size_t i = 1; i < ahead_.size() && count < steps.size(); ++i) {
    const double step = ahead_.time(i) - ahead_.time(i - 1);
    if (ahead_.info(i).segment == ahead_.info(0).segment && step > 0) steps[count++] = step;
  }
  return median(steps, count);
}

/// Rows at the front that share a stamp get times of their own, up to the next stamp.
void TimeRepair::spread_front() {
  if (rows_spread_ > 0) {  // of the group before
    --rows_spread_;
    return;
  }
  const double stamp = ahead_.time(0);
  std::size_t count = 1;
  while (count < ahead_.size() && ahead_.time(count) == stamp &&
         ahead_.info(count).segment == ahead_.info(0).segment) {
    ++count;
  }
  const bool has_next = count < ahead_.size() &&
                        ahead_.info(count).segment == ahead_.info(0).segment &&
                        ahead_.time(count) > stamp;
  const double to_next = has_next ? ahead_.time(count) - stamp : kUnknown;
  if (to_next <= kGapSteps * usual_stamp_step() && to_next < kUnknown) {
    stamp_steps_[stamp_step_count_++ % stamp_steps_.size()] = to_next;
    spacing_ = to_next / static_cast<double>(count);
  }  // else a gap, which is no place for rows, or the end: they come as those before
  if (count < 2) return;
  log_->add("repeated stamp", ahead_.info(1).line, 0,
            fmt::format("found time {} {} times, with other values each time; the rows are spread "
                        "evenly up to the next time",
                        stamp, count));
  for (std::size_t i = 1; i < count; ++i) {
    ahead_.values(i)[0] = stamp + spacing_ * static_cast<double>(i);
  }
  rows_spread_ = count - 1;
}

void TimeRepair::pushed() {
  if (ahead_.size() > (spread_stamps_ ? kLargestGroup : kLookAhead)) process_front();
}

void TimeRepair::finish() {
  while (!ahead_.empty()) process_front();
}

double TimeRepair::gap_limit() const {
  const double steps = static_cast<double>(untimed_ + 1);
  const double limit = kGapSteps * usual_step_ * steps;
  return usual_step_ < kSlowStep ? std::min(limit, kLongGap * steps) : limit;
}

/// The usual step of what lies ahead: the median, so that a gap or a new start does not matter.
void TimeRepair::estimate_step() {
  std::array<double, kLookAhead> steps{};
  std::size_t count = 0;
  for (std::size_t i = 1; i < ahead_.size() && count < steps.size(); ++i) {
    const double step = ahead_.time(i) - ahead_.time(i - 1);
    if (ahead_.info(i).segment == ahead_.info(0).segment && step > 0) steps[count++] = step;
  }
  usual_step_ = median(steps, count);
  step_count_ = 0;
}

void TimeRepair::learn_step(double step) {
  steps_[step_count_++] = step;
  if (step_count_ < steps_.size()) return;
  usual_step_ = median(steps_, step_count_);
  step_count_ = 0;
}

void TimeRepair::accept(bool starts_run) {
  next_->push(ahead_.values(0), ahead_.info(0), starts_run);
  std::copy(ahead_.values(0), ahead_.values(0) + width_, last_.begin());
  last_time_ = ahead_.time(0);
  untimed_ = 0;
  ahead_.pop_front();
}

void TimeRepair::drop(const char* kind, const std::string& message) {
  log_->add(kind, ahead_.info(0).line, 0, message);
  ahead_.pop_front();
}

void TimeRepair::begin_run(const char* why) {
  const double time = ahead_.time(0);
  if (why != nullptr) {
    log_->add(
        why, ahead_.info(0).line, 0,
        fmt::format("{}: found {} s after {} s; a new run begins here", why, time, last_time_));
  }
  estimate_step();
  if (!step_noticed_ && usual_step_ > kSlowStep && usual_step_ < kUnknown) {
    step_noticed_ = true;
    log_->add("slow", ahead_.info(0).line, 0,
              fmt::format("found a usual time step of {} s, expected time in seconds (not in ms or "
                          "us); taken as seconds",
                          usual_step_));
  }
  in_run_ = true;
  run_begin_ = time;
  accept(true);
}

/// Does the row after the front follow the last accepted one as if the front were not there?
bool TimeRepair::next_row_fits(double limit) const {
  if (ahead_.size() < 2 || ahead_.info(1).segment != segment_) return false;
  const double step = ahead_.time(1) - last_time_;
  return step > 0 && step <= limit + std::min(limit, usual_step_);
}

void TimeRepair::process_backward(double step) {
  const double time = ahead_.time(0);
  if (time <= run_begin_ + usual_step_ || -step > kRestartSteps * usual_step_) {
    begin_run("time starts again");
  } else {
    drop("out of order",
         fmt::format("found time {} after {}, expected it to increase; the row is left out", time,
                     last_time_));
  }
}

void TimeRepair::process_front() {
  if (spread_stamps_) spread_front();
  const RowInfo& info = ahead_.info(0);
  const double time = ahead_.time(0);
  const bool new_segment = in_run_ && info.segment != segment_;
  if (new_segment) in_run_ = false;
  segment_ = info.segment;
  if (std::isnan(time)) {
    ++untimed_;
    next_->push(ahead_.values(0), info, !in_run_);
    ahead_.pop_front();
    return;
  }
  if (!in_run_) {
    begin_run(nullptr);
    return;
  }
  const double step = time - last_time_;
  if (step == 0) {
    const double* values = ahead_.values(0);
    const bool same = std::equal(values, values + width_, last_.begin());
    if (same) {
      drop("twice", fmt::format("found the row of time {} a second time; left out", time));
    } else {
      drop("same time", fmt::format("found time {} a second time with other values, expected time "
                                    "to increase; the row is left out",
                                    time));
    }
    return;
  }
  const double limit = gap_limit();
  if (step > 0 && step <= limit) {
    if (untimed_ == 0) learn_step(step);
    accept(false);
  } else if (next_row_fits(limit)) {
    drop(
        "out of order",
        fmt::format("found time {} after {}, expected it to increase steadily; the row is left out",
                    time, last_time_));
  } else if (step < 0) {
    process_backward(step);
  } else {
    begin_run("time leaves a gap");
  }
}

}  // namespace dyngen::runtime
