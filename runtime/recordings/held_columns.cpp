// SPDX-License-Identifier: MIT
#include "runtime/recordings/held_columns.h"

#include <algorithm>
#include <vector>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kMostAlike = 0.7;      // of the stretches have the length of the period
constexpr Index kLongestHold = 64;      // samples: longer stretches are a constant signal
constexpr Index kFewestStretches = 64;  // fewer say nothing

/// The length that most stretches have, if kMostAlike of those up to kLongestHold have it; else 1.
class StretchLengths {
 public:
  void add(Index length) {
    if (length < 1 || length > kLongestHold) return;
    ++counts_[static_cast<std::size_t>(length)];
    ++all_;
  }
  [[nodiscard]] Index usual() const {
    const auto most = std::max_element(counts_.begin(), counts_.end());
    const bool regular = all_ > kFewestStretches &&
                         static_cast<double>(*most) > kMostAlike * static_cast<double>(all_);
    return regular ? most - counts_.begin() : 1;
  }
  [[nodiscard]] Index all() const { return all_; }

 private:
  std::vector<Index> counts_ = std::vector<Index>(kLongestHold + 1, 0);
  Index all_ = 0;
};

/// Period of single values between zeros; 1: there is none.
Index pulse_period(const Eigen::Ref<const VectorXd>& values) {
  StretchLengths gaps;
  Index last = -1, zeros = 0, neighbours = 0;
  for (Index k = 0; k < values.size(); ++k) {
    if (values[k] == 0) {
      ++zeros;
      continue;
    }
    if (last >= 0) {
      gaps.add(k - last);
      if (k - last == 1) ++neighbours;
    }
    last = k;
  }
  constexpr double kFewestZeros = 0.4, kMostNeighbours = 0.1;
  const bool pulses =
      static_cast<double>(zeros) >= kFewestZeros * static_cast<double>(values.size()) &&
      static_cast<double>(neighbours) <= kMostNeighbours * static_cast<double>(gaps.all());
  return pulses ? gaps.usual() : 1;
}

}  // namespace

HeldColumn find_held(const Eigen::Ref<const VectorXd>& values) {
  const Index pulses = pulse_period(values);
  if (pulses > 1) return {pulses, true};
  StretchLengths stretches;
  Index length = 1;
  for (Index k = 1; k < values.size(); ++k) {
    if (values[k] == values[k - 1]) {
      ++length;
      continue;
    }
    stretches.add(length);
    length = 1;
  }
  return {stretches.usual(), false};
}

void fill_held(const Eigen::Ref<const VectorXd>& time, const HeldColumn& held,
               Eigen::Ref<VectorXd> values) {
  if (held.period < 2) return;
  std::vector<Index> fresh;
  for (Index k = 0; k < values.size(); ++k) {
    const Index since = fresh.empty() ? 0 : k - fresh.back();
    const bool changes = k == 0 || values[k] != values[k - 1];
    // a constant signal is measured too
    const bool is_new = held.pulsed ? values[k] != 0 || since >= 2 * held.period
                                    : changes || since >= held.period;
    if (is_new) fresh.push_back(k);
  }
  const VectorXd given = values;
  for (std::size_t i = 0; i + 1 < fresh.size(); ++i) {
    const Index first = fresh[i], last = fresh[i + 1];
    const double slope = (given[last] - given[first]) / (time[last] - time[first]);
    for (Index k = first + 1; k < last; ++k) values[k] = given[first] + slope * (time[k] - time[first]);
  }
  if (fresh.empty()) return;
  // at the ends there is one value alone
  for (Index k = 0; k < fresh.front(); ++k) values[k] = given[fresh.front()];
  for (Index k = fresh.back(); k < values.size(); ++k) values[k] = given[fresh.back()];
}

}  // namespace dyngen::runtime
