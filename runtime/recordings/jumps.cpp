// SPDX-License-Identifier: MIT
#include "runtime/recordings/jumps.h"

#include <algorithm>
#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr Index kBesideJump = 8;

/// The value below which 70 % of them lie; reorders.
double usual_of(std::vector<double>& values) {
  constexpr double kUsual = 0.7;
  if (values.empty()) return 0;
  const auto place =
      values.begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// Does row k catch up with what was missed while the value before it was held?
bool is_late(const Eigen::Ref<const Eigen::VectorXd>& time,
             const Eigen::Ref<const Eigen::VectorXd>& x, Index k) {
  Index held = k - 1;  // the first row of that value
  while (held > 0 && x(held - 1) == x(k - 1)) --held;
  if (held == k - 1) return false;
  const Index reach = std::max<Index>(4, 2 * (k - held));
  const Index from = std::max<Index>(0, held - reach), to = std::min(x.size() - 1, k + reach);
  const double before = from < held ? std::abs((x(held) - x(from)) / (time(held) - time(from))) : 0;
  const double after = to > k ? std::abs((x(to) - x(k)) / (time(to) - time(k))) : 0;
  constexpr double kFaster = 2;
  return std::abs(x(k) - x(k - 1)) <= kFaster * std::max(before, after) * (time(k) - time(held));
}

}  // namespace

std::vector<Jump> find_jumps(const Eigen::Ref<const Eigen::VectorXd>& time,
                             const Eigen::Ref<const Eigen::VectorXd>& position, double sample_time,
                             double resolution) {
  constexpr double kLeast = 0.02, kMost = 0.3, kQuarterOfAcceleration = 400;
  constexpr double kSeconds = 10, kSteps = 5, kResolutions = 10;
  const double impossible =
      std::clamp(kQuarterOfAcceleration * sample_time * sample_time, kLeast, kMost);
  constexpr double kSlowest = 0.02;  // s: at a larger sample time a joint may well be elsewhere
  const auto& x = position;
  std::vector<Jump> found;
  if (!(sample_time > 0) || sample_time > kSlowest) return found;
  std::vector<double> steps, seconds;
  for (Index k = 4; k + 4 < x.size(); ++k) {
    const double step = x(k) - x(k - 1);
    if (std::abs(step) < impossible || is_late(time, x, k)) continue;
    steps.clear();
    seconds.clear();
    const auto collect = [&](Index from, Index to) {
      for (Index i = from + 1; i <= to; ++i) {
        steps.push_back(std::abs(x(i) - x(i - 1)));
        if (i > from + 1) seconds.push_back(std::abs(x(i) - 2 * x(i - 1) + x(i - 2)));
      }
    };
    collect(std::max<Index>(0, k - 1 - kBesideJump), k - 1);
    collect(k, std::min(x.size() - 1, k + kBesideJump));
    constexpr Index kSlope = 3;
    const double before = (x(k - 1) - x(k - 1 - kSlope)) / (time(k - 1) - time(k - 1 - kSlope));
    const double after = (x(k + kSlope) - x(k)) / (time(k + kSlope) - time(k));
    const double size = step - (before + after) / 2 * (time(k) - time(k - 1));
    const double usual = usual_of(steps);
    if (std::abs(size) < std::max({impossible, kSeconds * usual_of(seconds), kSteps * usual,
                                   kResolutions * resolution})) {
      continue;
    }
    const double along = (before + after) * size >= 0 ? 1 : -1;
    found.push_back({k, size, along * std::abs(size) / std::max(usual, 1e-9)});
  }
  return found;
}

}  // namespace dyngen::runtime
