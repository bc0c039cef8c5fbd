// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/effects/work_count.h"

namespace dyngen::runtime {

/// A bound on the work of a diagnosis. Where several threads work, it is asked between pieces of
/// work whose size does not depend on the number of threads: the same work is cut off everywhere.
class Effort {
 public:
  /// @param limit  1e9 multiplications (WorkCount); 0: none  @param work  null: it is not counted
  Effort(double limit, std::shared_ptr<const WorkCount> work)
      : limit_(limit), work_(std::move(work)) {}

  /// Whether the work is done that may be done; then a search is left out, or ends.
  /// @param cut_off  gets the name of the search
  bool spent(const std::string& search, std::vector<std::string>& cut_off) const {
    if (limit_ <= 0 || !work_ || work_->done() < limit_) return false;
    if (std::find(cut_off.begin(), cut_off.end(), search) == cut_off.end()) {
      cut_off.push_back(search);
    }
    return true;
  }

 private:
  double limit_;
  std::shared_ptr<const WorkCount> work_;
};

}  // namespace dyngen::runtime
