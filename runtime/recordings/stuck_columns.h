// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// Samples of a column that repeat one number because nothing new came.
struct Stuck {
  Eigen::Index first = 0, count = 0;  ///< rows within the run; they are no measurement
};

/// At least so many samples, and so long (s): shorter is a sensor that holds its value.
inline constexpr Eigen::Index kFewestStuck = 20;
inline constexpr double kShortestStuck = 0.05;

/// A position that freezes while the joint moves, and then jumps by what it missed. In a column that
/// hardly ever repeats a value: one that stops and goes on within a sample too, as where the joint
/// turns back meanwhile. Not of a sensor that holds its values most of the time.
///
/// @param resolution  a small step of the column
std::vector<Stuck> find_frozen_positions(const Eigen::Ref<const Eigen::VectorXd>& time,
                                         const Eigen::Ref<const Eigen::VectorXd>& position,
                                         double sample_time, double resolution);

/// A torque that is exactly one number while its joint moves, where equal values in succession are
/// rare otherwise. At its least or largest value it is no wonder: torque is limited there.
///
/// @param moved  how far a joint goes that moves
std::vector<Stuck> find_stuck_torques(const Eigen::Ref<const Eigen::VectorXd>& time,
                                      const Eigen::Ref<const Eigen::VectorXd>& position,
                                      const Eigen::Ref<const Eigen::VectorXd>& torque,
                                      double moved);

}  // namespace dyngen::runtime
