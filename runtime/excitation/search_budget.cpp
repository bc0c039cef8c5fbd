// SPDX-License-Identifier: MIT
#include "runtime/excitation/search_budget.h"

#include <algorithm>

namespace dyngen::runtime {
namespace {

constexpr double kLeastSeconds = 0.01;

}  // namespace

double SearchBudget::seconds_left() const {
  const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begin_;
  return seconds_ - gone.count();
}

SearchBudget::Part SearchBudget::of_all(double share) const {
  Part part;
  if (evaluations_ > 0) {
    part.evaluations =
        std::clamp(static_cast<int>(share * evaluations_), 2, std::max(2, evaluations_ - used_));
  } else {
    part.seconds = std::max(kLeastSeconds, std::min(share * seconds_, seconds_left()));
  }
  return part;
}

SearchBudget::Part SearchBudget::of_rest(double share) const {
  Part part;
  if (evaluations_ > 0) {
    part.evaluations = std::max(1, static_cast<int>(share * (evaluations_ - used_)));
  } else {
    part.seconds = std::max(kLeastSeconds, share * seconds_left());
  }
  return part;
}

}  // namespace dyngen::runtime
