// SPDX-License-Identifier: MIT
#include "runtime/recordings/clipping.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr Index kFewestClipped = 5, kInSuccession = 3, kTimesAsMany = 5;
constexpr int kNeighbours = 5;

Index longest_succession(const Eigen::Ref<const Eigen::VectorXd>& signal, double value) {
  Index longest = 0, current = 0;
  for (const double sample : signal) {
    current = sample == value ? current + 1 : 0;
    longest = std::max(longest, current);
  }
  return longest;
}

/// How often the most frequent of the values next to the first one occurs.
Index most_frequent_neighbour(const std::vector<double>& sorted, Index at_extreme) {
  Index most = 0, current = 0;
  int distinct = 0;
  for (std::size_t i = static_cast<std::size_t>(at_extreme); i < sorted.size(); ++i) {
    if (current == 0 || sorted[i] != sorted[i - 1]) {
      current = 0;
      if (++distinct > kNeighbours) break;
    }
    most = std::max(most, ++current);
  }
  return most;
}

/// `sorted` from the extreme inwards.
bool piles_up(const Eigen::Ref<const Eigen::VectorXd>& signal, const std::vector<double>& sorted,
              Index at_extreme) {
  const double extreme = sorted.front();
  return extreme != 0 && at_extreme >= kFewestClipped && at_extreme < signal.size() &&
         at_extreme >= kTimesAsMany * most_frequent_neighbour(sorted, at_extreme) &&
         longest_succession(signal, extreme) >= kInSuccession;
}

}  // namespace

Clipping find_clipping(const Eigen::Ref<const Eigen::VectorXd>& signal) {
  Clipping clipping;
  if (signal.size() == 0) return clipping;
  std::vector<double> sorted(signal.begin(), signal.end());
  std::sort(sorted.begin(), sorted.end());
  clipping.lower = sorted.front();
  clipping.upper = sorted.back();
  clipping.at_lower = std::count(signal.begin(), signal.end(), clipping.lower);
  clipping.at_upper = std::count(signal.begin(), signal.end(), clipping.upper);
  clipping.clipped = piles_up(signal, sorted, clipping.at_lower);
  std::reverse(sorted.begin(), sorted.end());
  clipping.clipped = clipping.clipped || piles_up(signal, sorted, clipping.at_upper);
  return clipping;
}

}  // namespace dyngen::runtime
