// SPDX-License-Identifier: MIT
#include "runtime/recordings/stuck_columns.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using ConstColumn = Eigen::Ref<const Eigen::VectorXd>;

/// Calls `visit(first, last)` for each stretch of equal values that is long enough.
void for_each_plateau(const ConstColumn& time, const ConstColumn& values,
                      const std::function<void(Index, Index)>& visit) {
  for (Index first = 0; first < values.size();) {
    Index last = first;
    while (last + 1 < values.size() && values(last + 1) == values(first)) ++last;
    if (last - first + 1 >= kFewestStuck && time(last) - time(first) >= kShortestStuck) {
      visit(first, last);
    }
    first = last + 1;
  }
}

Index equal_steps(const ConstColumn& values) {
  Index equal = 0;
  for (Index i = 1; i < values.size(); ++i) equal += values(i) == values(i - 1) ? 1 : 0;
  return equal;
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Is there noise on a column, so that no two of its values are equal but by chance?
bool is_noisy(const ConstColumn& values) {
  constexpr double kSmooth =
      0.5;  // of the steps: a signal far below the sampling frequency has less
  std::vector<double> steps, seconds;
  for (Index i = 2; i < values.size(); ++i) {
    if (values(i) == values(i - 1)) continue;
    steps.push_back(std::abs(values(i) - values(i - 1)));
    seconds.push_back(std::abs(values(i) - 2 * values(i - 1) + values(i - 2)));
  }
  return median_of(std::move(seconds)) > kSmooth * median_of(std::move(steps));
}

/// How far positions are off the line through the first and the last of them.
double off_line(const ConstColumn& time, const ConstColumn& position, Index first, Index last) {
  const double rise = (position(last) - position(first)) / (time(last) - time(first));
  double farthest = 0;
  for (Index i = first; i <= last; ++i) {
    farthest = std::max(farthest,
                        std::abs(position(i) - position(first) - rise * (time(i) - time(first))));
  }
  return farthest;
}

double largest_step(const ConstColumn& values, Index from, Index to) {
  double largest = 0;
  for (Index i = std::max<Index>(from, 0) + 1; i <= std::min(to, values.size() - 1); ++i) {
    largest = std::max(largest, std::abs(values(i) - values(i - 1)));
  }
  return largest;
}

double mean_speed(const ConstColumn& time, const ConstColumn& values, Index from, Index to) {
  from = std::max<Index>(from, 0);
  to = std::min(to, values.size() - 1);
  return from < to ? (values(to) - values(from)) / (time(to) - time(from)) : 0;
}

constexpr Index kBeside = 8;  // samples on either side of a plateau that tell how its joint moved

/// Does a joint stop within one sample, and go on within one? What brakes gets slower before it
/// stands.
bool stops_at_once(const ConstColumn& position, Index first, Index last) {
  constexpr double kFull = 0.7;  // of the largest step beside: a brake of 8 samples leaves 1/8
  const double before = std::abs(position(first) - position(first - 1));
  const double after = std::abs(position(last + 2) - position(last + 1));
  const double largest_before = largest_step(position, first - kBeside, first);
  const double largest_after = largest_step(position, last + 1, last + 1 + kBeside);
  return before > 0 && after > 0 && before >= kFull * largest_before &&
         after >= kFull * largest_after;
}

}  // namespace

std::vector<Stuck> find_frozen_positions(const ConstColumn& time, const ConstColumn& position,
                                         double sample_time, double resolution) {
  constexpr double kLeast = 0.002, kHalfOfAcceleration = 400;  // 800 rad/s^2 make no such jump
  constexpr double kSteps = 5, kManySteps = 8, kResolutions = 10, kMissed = 0.5;
  constexpr double kHeld = 0.85, kRare = 0.01;
  constexpr double kSeldom = 0.15;  // of a column: a motion with pauses stands for longer
  std::vector<Stuck> sure, abrupt;
  Index in_plateaus = 0, in_abrupt = 0;
  for_each_plateau(time, position, [&](Index first, Index last) {
    if (first < kBeside || last + 2 >= position.size()) return;
    const Stuck plateau{first + 1, last - first};  // the first of them is a measurement
    const double jump = position(last + 1) - position(last);
    const double step = std::max(largest_step(position, first - kBeside, first),
                                 largest_step(position, last + 1, last + 1 + kBeside));
    const bool jumps =
        std::abs(jump) >= std::max({kLeast, kHalfOfAcceleration * sample_time * sample_time,
                                    kSteps * step, kResolutions * resolution});
    const double speed = (mean_speed(time, position, first - kBeside, first) +
                          mean_speed(time, position, last + 1, last + 1 + kBeside)) /
                         2;
    const double missed = speed * (time(last + 1) - time(first));
    const bool agrees =
        std::abs(jump - missed) <= kMissed * std::max(std::abs(jump), std::abs(missed));
    if (jumps && (agrees || std::abs(jump) >= kManySteps * step)) {
      sure.push_back(plateau);
    } else if (jumps || stops_at_once(position, first, last)) {
      abrupt.push_back(plateau);
      in_abrupt += plateau.count;
    } else {
      return;
    }
    in_plateaus += plateau.count;
  });
  const auto others = static_cast<double>(position.size() - 1 - in_plateaus);
  const auto held = static_cast<double>(equal_steps(position) - in_plateaus);
  // A sensor that holds most of its values, or a coarse one, is as it always is.
  if (held > kHeld * others) return {};
  // Where a column hardly ever repeats a value, many in succession are no measurements.
  const bool seldom =
      static_cast<double>(in_abrupt) <= kSeldom * static_cast<double>(position.size());
  if (held <= kRare * others && seldom) sure.insert(sure.end(), abrupt.begin(), abrupt.end());
  std::sort(sure.begin(), sure.end(),
            [](const Stuck& a, const Stuck& b) { return a.first < b.first; });
  return sure;
}

std::vector<Stuck> find_stuck_torques(const ConstColumn& time, const ConstColumn& position,
                                      const ConstColumn& torque, double moved) {
  constexpr double kBent = 0.2;
  std::vector<Stuck> candidates;
  const bool noisy = is_noisy(torque);
  Index in_candidates = 0;
  const double least = torque.size() > 0 ? torque.minCoeff() : 0;
  const double largest = torque.size() > 0 ? torque.maxCoeff() : 0;
  for_each_plateau(time, torque, [&](Index first, Index last) {
    const auto positions = position.segment(first, last - first + 1);
    const bool limited = torque(first) == least || torque(first) == largest;
    if (limited || positions.maxCoeff() - positions.minCoeff() < moved) return;
    // Without noise, the torque of a joint of constant speed may well be constant.
    if (!noisy && off_line(time, position, first, last) < kBent * moved) return;
    candidates.push_back({first + 1, last - first});
    in_candidates += last - first;
  });
  constexpr double kRare = 0.1;
  const Index others = torque.size() - 1 - in_candidates;
  const bool rare = static_cast<double>(equal_steps(torque) - in_candidates) <=
                    kRare * static_cast<double>(others);
  return others > 0 && rare ? candidates : std::vector<Stuck>();
}

}  // namespace dyngen::runtime
