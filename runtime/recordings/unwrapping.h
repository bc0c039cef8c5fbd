// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

/// What unwrap() did to a column.
struct Unwrapping {
  Eigen::Index count = 0;  ///< jumps of a whole turn
  Eigen::Index row = 0;    ///< after the first of them
  double before = 0, after = 0;
};

/// Makes a revolute position continuous that was recorded within one turn (-pi .. pi, 0 .. 2 pi).
///
/// A jump counts where all values lie within a turn, the column moves slowly otherwise, and from
/// one sample to the next it is a turn up to max(0.2 rad, 5 times the step before) with a step
/// before of less than a quarter turn. Up to 10 samples between the ends of a jump that somebody
/// has interpolated are put on the line. A gap in time is crossed as the speeds at its ends say;
/// where time starts again, the position does too.
/// @param recording  whose times and runs they are
/// @param position   (N) changed
Unwrapping unwrap(const Recording& recording, Eigen::Ref<Eigen::VectorXd> position);

}  // namespace dyngen::runtime
