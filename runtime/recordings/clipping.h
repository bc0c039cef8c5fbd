// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// Whether a signal was cut off at its extremes, as a saturated drive does to torque.
struct Clipping {
  double lower = 0, upper = 0;              ///< the extreme values
  Eigen::Index at_lower = 0, at_upper = 0;  ///< samples that have exactly this value
  bool clipped = false;
};

/// Looks for a pile of samples at exactly the largest or smallest value.
///
/// Clipped: five samples or more at that value, three or more of them in succession, and five times
/// as many as at any of the next few values inside. (The crest of a smooth quantised signal has
/// about 2.4 times as many as the value below.) An extreme of exactly 0 is no clipping.
/// @param signal  (N) a torque column, as measured
Clipping find_clipping(const Eigen::Ref<const Eigen::VectorXd>& signal);

}  // namespace dyngen::runtime
