// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <limits>

namespace dyngen::runtime {

/// What a search may take: evaluations, or seconds where those are not limited. What ends by the
/// clock is not repeated exactly.
class SearchBudget {
 public:
  struct Part {
    int evaluations = std::numeric_limits<int>::max();
    double seconds = 1e9;
  };

  /// @param evaluations  0: no limit       @param seconds  from now; where evaluations have no
  /// limit
  SearchBudget(int evaluations, double seconds) : evaluations_(evaluations), seconds_(seconds) {}

  void use(int evaluations) { used_ += evaluations; }
  [[nodiscard]] int used() const { return used_; }
  [[nodiscard]] bool spent() const {
    return evaluations_ > 0 ? used_ >= evaluations_ : seconds_left() < 0;
  }

  /// A share of all of it, no more than is left. @param share  0 .. 1
  [[nodiscard]] Part of_all(double share) const;
  /// A share of what is left.
  [[nodiscard]] Part of_rest(double share) const;

 private:
  [[nodiscard]] double seconds_left() const;

  int evaluations_;
  double seconds_;
  int used_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace dyngen::runtime
