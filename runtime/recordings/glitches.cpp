// SPDX-License-Identifier: MIT
#include "runtime/recordings/glitches.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr Index kLongestGlitch = 3;
constexpr Index kNearGlitch = 8;  // samples on either side that say what is usual

/// The value below which a part of them lies; reorders.
double quantile_of(std::vector<double>& values, double part) {
  if (values.empty()) return 0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// What is usual near a glitch: quantiles, so that another one near by does not hide it.
struct Neighbourhood {
  double step = 0;    ///< from sample to sample
  double second = 0;  ///< second difference
  bool known = false;
  bool moves = false;  ///< some values next to the glitch differ
};

class PositionGlitches {
 public:
  PositionGlitches(const Eigen::Ref<const Eigen::VectorXd>& time, Eigen::Ref<Eigen::VectorXd> x,
                   double sample_time, double resolution)
      : time_(time), x_(x), sample_time_(sample_time), resolution_(resolution) {}

  std::vector<Glitch> repair() {
    constexpr int kPasses = 4;  // one that hides another is gone in the next
    for (int pass = 0; pass < kPasses; ++pass) {
      const std::size_t before = found_.size();
      for (Index k = 1; k + 1 < x_.size(); ++k) repair_at(k);
      if (found_.size() == before) break;
    }
    look_at_ends();
    std::sort(found_.begin(), found_.end(),
              [](const Glitch& a, const Glitch& b) { return a.first < b.first; });
    return found_;
  }

 private:
  /// What no joint does within `count` samples and back.
  [[nodiscard]] double impossible(Index count) const {
    constexpr double kLeast = 0.002, kMost = 0.3, kEighthOfAcceleration = 100;
    const double duration = static_cast<double>(count + 1) * sample_time_;
    return std::clamp(kEighthOfAcceleration * duration * duration, kLeast, kMost);
  }

  /// Samples left - kNearGlitch .. left and right .. right + kNearGlitch; -1: none on that side.
  [[nodiscard]] Neighbourhood around(Index left, Index right) const {
    std::vector<double> steps, seconds;
    Neighbourhood near;
    const auto collect = [&](Index from, Index to) {
      for (Index i = from + 1; i <= to; ++i) {
        steps.push_back(std::abs(x_(i) - x_(i - 1)));
        if (i > from + 1) seconds.push_back(std::abs(x_(i) - 2 * x_(i - 1) + x_(i - 2)));
      }
    };
    if (left >= 0) collect(std::max<Index>(0, left - kNearGlitch), left);
    if (right >= 0) collect(right, std::min(x_.size() - 1, right + kNearGlitch));
    constexpr std::size_t kFewestSeconds = 5;
    constexpr double kUsual = 0.7;
    near.known = seconds.size() >= kFewestSeconds;
    near.moves = std::any_of(steps.begin(), steps.end(), [](double step) { return step > 0; });
    near.step = quantile_of(steps, kUsual);
    near.second = quantile_of(seconds, kUsual);
    return near;
  }

  [[nodiscard]] double threshold(const Neighbourhood& near, Index count) const {
    constexpr double kSeconds = 10, kSteps = 3, kResolutions = 5;
    return std::max({impossible(count), kSeconds * near.second, kSteps * near.step,
                     kResolutions * resolution_});
  }

  /// Least distance of samples k .. k + count - 1 from the range of their neighbours; negative if
  /// one lies within.
  [[nodiscard]] double outside(Index k, Index count) const {
    const auto [low, high] = std::minmax({x_(k - 1), x_(k + count)});
    double least = -1;
    for (Index i = k; i < k + count; ++i) {
      const double off = std::max(low - x_(i), x_(i) - high);
      least = i == k ? off : std::min(least, off);
    }
    return least;
  }

  /// Do slopes before and after go on across the glitch?
  [[nodiscard]] bool goes_on(Index left, Index right, double off) const {
    constexpr Index kSlope = 4;
    constexpr double kMismatch = 0.25;  // of how far the glitch is off
    const auto slope = [&](Index from, Index to) {
      return from == to ? 0 : (x_(to) - x_(from)) / (time_(to) - time_(from));
    };
    const double before = slope(std::max<Index>(0, left - kSlope), left);
    const double after = slope(right, std::min(x_.size() - 1, right + kSlope));
    const double sides = (left > 0 ? 1 : 0) + (right + 1 < x_.size() ? 1 : 0);
    const double expected = sides > 0 ? (before + after) / sides : 0;
    const double across = slope(left, right);
    return std::abs(across - expected) * (time_(right) - time_(left)) <= kMismatch * off;
  }

  void repair_at(Index k) {
    for (Index count = 1; count <= kLongestGlitch && k + count < x_.size(); ++count) {
      const double off = outside(k, count);
      if (off < impossible(count)) continue;
      const Index left = k - 1, right = k + count;
      const Neighbourhood near = around(left, right);
      if (!near.known || off < threshold(near, count) || !goes_on(left, right, off)) continue;
      found_.push_back({k, count, false, x_(k)});
      for (Index i = k; i < right; ++i) {
        const double share = (time_(i) - time_(left)) / (time_(right) - time_(left));
        x_(i) = x_(left) + share * (x_(right) - x_(left));
      }
      return;
    }
  }

  /// At an end nothing says that the signal comes back, so more is asked of how far it is off, and
  /// that the joint moves: behind a sensor that was held a jump is no glitch.
  void look_at_ends() {
    constexpr double kMore = 3;
    const Index size = x_.size();
    for (Index count = 1; count <= kLongestGlitch && count + 4 < size; ++count) {
      const Neighbourhood near = around(-1, count);
      double least = std::abs(x_(0) - x_(count));
      for (Index i = 1; i < count; ++i) least = std::min(least, std::abs(x_(i) - x_(count)));
      if (near.known && near.moves && least >= kMore * threshold(near, count)) {
        found_.push_back({0, count, true, x_(0)});
        break;
      }
    }
    for (Index count = 1; count <= kLongestGlitch && count + 4 < size; ++count) {
      const Index last_good = size - count - 1;
      const Neighbourhood near = around(last_good, -1);
      double least = std::abs(x_(size - 1) - x_(last_good));
      for (Index i = last_good + 1; i < size; ++i) {
        least = std::min(least, std::abs(x_(i) - x_(last_good)));
      }
      if (near.known && near.moves && least >= kMore * threshold(near, count)) {
        found_.push_back({last_good + 1, count, true, x_(last_good + 1)});
        break;
      }
    }
  }

  const Eigen::Ref<const Eigen::VectorXd>& time_;
  Eigen::Ref<Eigen::VectorXd> x_;
  double sample_time_, resolution_;
  std::vector<Glitch> found_;
};

}  // namespace

std::vector<Glitch> repair_position_glitches(const Eigen::Ref<const Eigen::VectorXd>& time,
                                             Eigen::Ref<Eigen::VectorXd> position,
                                             double sample_time, double resolution) {
  if (position.size() < kNearGlitch || !(sample_time > 0)) return {};
  return PositionGlitches(time, position, sample_time, resolution).repair();
}

std::vector<Glitch> repair_torque_glitches(const Eigen::Ref<const Eigen::VectorXd>& time,
                                           Eigen::Ref<Eigen::VectorXd> torque, double range) {
  constexpr double kRanges = 2;
  std::vector<Glitch> found;
  const Index size = torque.size();
  if (size < kNearGlitch || !(range > 0)) return found;
  // At an end of a run the answer to a step looks alike, so more is asked.
  constexpr double kAtEnd = 2;
  const auto far = [&](Index k, double from, bool at_end) {
    return std::abs(torque(k) - from) > (at_end ? kAtEnd : 1) * kRanges * range;
  };
  for (Index k = 0; k < size; ++k) {
    for (Index count = 1; count <= kLongestGlitch && k + count <= size; ++count) {
      const Index left = k - 1, right = k + count;
      const bool at_end = left < 0 || right >= size;
      if (left < 0 && right >= size) break;
      const double before = torque(left < 0 ? right : left);
      const double after = torque(right >= size ? left : right);
      if (std::abs(after - before) > range / 2) continue;
      bool all_far = true;
      for (Index i = k; i < k + count; ++i)
        all_far = all_far && far(i, (before + after) / 2, at_end);
      if (!all_far) continue;
      found.push_back({k, count, at_end, torque(k)});
      if (!at_end) {
        for (Index i = k; i < right; ++i) {
          const double share = (time(i) - time(left)) / (time(right) - time(left));
          torque(i) = before + share * (after - before);
        }
      }
      k += count - 1;
      break;
    }
  }
  return found;
}

}  // namespace dyngen::runtime
