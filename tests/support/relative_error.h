// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace dyngen::test {

/// max |a - b| over max |b|, over a whole set of values: b is the reference.
///
/// Components near zero are so judged against the largest of the set, as torques of one robot
/// should be. A NaN or infinity anywhere, a length that differs, or nothing compared at all counts
/// as an infinite error, so that a comparison cannot pass by accident.
class RelativeError {
 public:
  template <typename A, typename B>
  void add(A actual, B reference) {
    // long double holds both kinds of argument exactly.
    const long double a = actual;
    const long double b = reference;
    compared_ = true;
    if (!std::isfinite(a) || !std::isfinite(b)) {
      broken_ = true;
      return;
    }
    difference_ = std::max(difference_, std::fabs(a - b));
    scale_ = std::max(scale_, std::fabs(b));
  }

  template <typename A, typename B>
  void add(const std::vector<A>& actual, const std::vector<B>& reference) {
    if (actual.size() != reference.size()) broken_ = true;
    for (std::size_t i = 0; i < std::min(actual.size(), reference.size()); ++i) {
      add(actual[i], reference[i]);
    }
  }

  [[nodiscard]] double value() const {
    if (broken_ || !compared_) return std::numeric_limits<double>::infinity();
    if (difference_ == 0) return 0;
    if (scale_ == 0) return std::numeric_limits<double>::infinity();
    return static_cast<double>(difference_ / scale_);
  }

 private:
  long double difference_ = 0;
  long double scale_ = 0;
  bool compared_ = false;
  bool broken_ = false;
};

template <typename A, typename B>
double relative_error(const std::vector<A>& actual, const std::vector<B>& reference) {
  RelativeError error;
  error.add(actual, reference);
  return error.value();
}

}  // namespace dyngen::test
