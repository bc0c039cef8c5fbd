// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// One to three samples of a column that stand off while the signal before and after goes on as if
/// they were not there.
struct Glitch {
  Eigen::Index first = 0, count = 0;  ///< rows within the run
  bool at_end = false;  ///< of the run, which has no sample on the other side: to be left out
  double value = 0;     ///< of its first sample, as it was
};

/// Finds glitches of one run of a position and puts its samples on the line between their
/// neighbours, but for those at an end of the run.
///
/// A sample stands off if it is outside the range of its neighbours by at least 0.002, by what 800
/// rad/s^2 do (up to 0.3), by 10 times the second differences and 3 times the steps of the 8
/// samples on either side, and by 5 times the resolution; and the slopes before and after go on
/// across it. A sample that is held, or comes late, lies within the range of its neighbours.
/// @param resolution   a small step of the column, as of a coarse encoder
std::vector<Glitch> repair_position_glitches(const Eigen::Ref<const Eigen::VectorXd>& time,
                                             Eigen::Ref<Eigen::VectorXd> position,
                                             double sample_time, double resolution);

/// The same of a torque: samples that stand off the line between their neighbours by more than
/// twice `range`, that of all but the extreme values.
std::vector<Glitch> repair_torque_glitches(const Eigen::Ref<const Eigen::VectorXd>& time,
                                           Eigen::Ref<Eigen::VectorXd> torque, double range);

}  // namespace dyngen::runtime
