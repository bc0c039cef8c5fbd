// SPDX-License-Identifier: MIT
#include "runtime/recordings/unwrapping.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "runtime/recordings/time_base.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kQuarter = kTurn / 4;

/// Of all steps within runs; 0 of none.
double median_step(const Recording& recording, const Eigen::Ref<const Eigen::VectorXd>& position) {
  std::vector<double> steps;
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    for (Index k = recording.run_starts[run] + 1; k < run_end(recording, run); ++k) {
      steps.push_back(std::abs(position(k) - position(k - 1)));
    }
  }
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// But for a few values that no sensor gave.
bool lies_within_a_turn(const Eigen::Ref<const Eigen::VectorXd>& position) {
  constexpr double kSlack = 0.05;  // rad, of noise and of calibration
  constexpr double kTail = 0.005;  // of all values, at either end
  std::vector<double> values(position.begin(), position.end());
  const auto tail = static_cast<std::ptrdiff_t>(kTail * static_cast<double>(values.size()));
  const auto low = values.begin() + tail, high = values.end() - 1 - tail;
  std::nth_element(values.begin(), low, values.end());
  const double least = *low;
  std::nth_element(values.begin(), high, values.end());
  return *high - least <= kTurn + kSlack;
}

/// A column while it is unwrapped, run by run.
class Unwrapper {
 public:
  Unwrapper(const Recording& recording, Eigen::Ref<Eigen::VectorXd> position)
      : time_(recording.time), position_(position) {}

  void run(Index first, Index end) {
    double offset = 0, before = 0;
    for (Index k = first + 1; k < end; ++k) {
      const Index jump = jump_at(k, end, before, offset);
      if (jump == 0) {
        before = position_(k) + offset - position_(k - 1);
        position_(k) += offset;
        continue;
      }
      const double step = position_(k + jump - 1) + offset - position_(k - 1);
      const double turn = step > 0 ? -kTurn : kTurn;
      note(k, offset);
      offset += turn;
      put_on_line(k - 1, k + jump - 1, position_(k + jump - 1) + offset);
      k += jump - 1;
      before = position_(k) - position_(k - 1);
    }
  }

  /// Adds whole turns to a run that follows a gap.
  void join(Index first, Index end) {
    const double turns = std::round((expected_after_gap(first, end) - position_(first)) / kTurn);
    position_.segment(first, end - first).array() += turns * kTurn;
  }

  /// Looks for a jump that a short gap hides: the position that comes is a turn off the one that
  /// the speeds on both sides lead to.
  void look_into_gap(Index first, Index end) {
    if (time_(first) - time_(first - 1) >= kShortGap) return;
    constexpr double kClose = 0.5;  // rad
    const double off = expected_after_gap(first, end) - position_(first);
    if (std::abs(std::abs(off) - kTurn) < kClose) note(first, 0);
  }

  [[nodiscard]] const Unwrapping& found() const { return found_; }

 private:
  static constexpr double kShortGap = 0.5;  // s: longer, speeds at the ends say nothing

  [[nodiscard]] double expected_after_gap(Index first, Index end) const {
    const double gap = time_(first) - time_(first - 1);
    const double before = position_(first - 1);
    if (gap >= kShortGap || first < 2 || first + 1 >= end) return before;
    return before + gap / 2 * (speed(first - 1) + speed(first + 1));
  }

  [[nodiscard]] double speed(Index k) const {
    const double step = time_(k) - time_(k - 1);
    return step > 0 ? (position_(k) - position_(k - 1)) / step : 0;
  }

  /// How many samples after k - 1 a jump of a turn ends; 0: none begins at k.
  /// @param before  the step before it   @param offset  of samples from k on
  [[nodiscard]] Index jump_at(Index k, Index end, double before, double offset) const {
    constexpr double kPartOfJump = kTurn / 40;  // less than what one of ten interpolated has
    if (std::abs(before) >= kQuarter) return 0;
    if (std::abs(position_(k) + offset - position_(k - 1)) < kPartOfJump) return 0;
    constexpr double kClose = 0.2, kFaster = 5;
    constexpr Index kLongest = 11;
    Index best = 0;
    double least = 0;
    for (Index jump = 1; jump <= kLongest && k + jump - 1 < end; ++jump) {
      const double whole = position_(k + jump - 1) + offset - position_(k - 1);
      const double off = std::abs(std::abs(whole) - kTurn);
      const double close = std::max(kClose, kFaster * std::abs(before) * static_cast<double>(jump));
      if (off > std::min(close, kQuarter) || !is_bridge(k, jump, offset)) {
        if (best > 0) break;
      } else if (best == 0 || off < least) {
        best = jump;
        least = off;
        if (jump == 1) break;
      } else {
        break;
      }
    }
    return best;
  }

  /// Were the samples of a jump put between its ends by somebody who did not know that it is none?
  /// Two samples may be anything: a filter's, or bad ones.
  [[nodiscard]] bool is_bridge(Index k, Index jump, double offset) const {
    constexpr Index kFew = 3;
    constexpr double kOnLine = 1e-6;  // rad
    if (jump <= kFew) return true;
    const Index right = k + jump - 1;
    const double begin = position_(k - 1);
    const double rise = position_(right) + offset - begin;
    for (Index i = k; i < right; ++i) {
      const double share = (time_(i) - time_(k - 1)) / (time_(right) - time_(k - 1));
      if (std::abs(position_(i) + offset - begin - share * rise) > kOnLine) return false;
    }
    return true;
  }

  void put_on_line(Index left, Index right, double after) {
    const double before = position_(left);
    for (Index k = left + 1; k < right; ++k) {
      const double share = (time_(k) - time_(left)) / (time_(right) - time_(left));
      position_(k) = before + share * (after - before);
    }
    position_(right) = after;
  }

  void note(Index k, double offset) {
    if (found_.count++ > 0) return;
    found_.row = k;
    found_.before = position_(k - 1);
    found_.after = position_(k) + offset;
  }

  Eigen::Ref<const Eigen::VectorXd> time_;
  Eigen::Ref<Eigen::VectorXd> position_;
  Unwrapping found_;
};

}  // namespace

Unwrapping unwrap(const Recording& recording, Eigen::Ref<Eigen::VectorXd> position) {
  constexpr double kSlow = 0.5;  // rad a sample: white noise is faster
  if (recording.samples() < 2 || !lies_within_a_turn(position) ||
      median_step(recording, position) > kSlow) {
    return {};
  }
  Unwrapper unwrapper(recording, position);
  for (std::size_t run = 0; run < recording.run_starts.size(); ++run) {
    unwrapper.run(recording.run_starts[run], run_end(recording, run));
  }
  const auto for_each_gap = [&](const auto& visit) {
    for (std::size_t run = 1; run < recording.run_starts.size(); ++run) {
      const Index first = recording.run_starts[run];
      if (recording.time(first) > recording.time(first - 1)) visit(first, run_end(recording, run));
    }
  };
  for_each_gap([&](Index first, Index end) { unwrapper.look_into_gap(first, end); });
  if (unwrapper.found().count == 0) return {};
  for_each_gap([&](Index first, Index end) { unwrapper.join(first, end); });
  return unwrapper.found();
}

}  // namespace dyngen::runtime
