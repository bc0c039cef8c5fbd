// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace dyngen::runtime {

/// By how much a gear twists under a load: rad or m, and its slope by the load.
struct Twist {
  double value = 0;
  double slope = 0;
};

/// The spring between a drive and its link, given by its twist under each load.
///
/// Its stiffness is limited, so that each twist has one torque: from the load on at which the law's
/// slope falls below the floor, the twist grows by the floor's slope. That load is looked for
/// between 1e-6 and 1e9 N m or N on either side, at 40 places in each decade.
class JointSpring {
 public:
  /// @param law    twist of a load; 0 without load, its slope positive there, smooth
  /// @param floor  smallest slope, rad/(N m) or m/N: positive and below the slope without load
  /// @throws std::invalid_argument  if floor is not that
  JointSpring(std::function<Twist(double load)> law, double floor);

  /// Twist of a load, its stiffness limited.
  [[nodiscard]] Twist twist(double load) const;
  /// The load of a twist: N m or N, by Newton's method within a bracket.
  [[nodiscard]] double load(double twist) const;

 private:
  [[nodiscard]] double first_stiff_load(double side) const;

  std::function<Twist(double load)> law_;
  double floor_;
  double softness_;                        ///< slope without load
  double lowest_ = 0, highest_ = 0;        ///< loads between which the law holds
  double at_lowest_ = 0, at_highest_ = 0;  ///< twists there
};

}  // namespace dyngen::runtime
