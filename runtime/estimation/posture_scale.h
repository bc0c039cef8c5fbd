// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// rad: how exactly a joint's zero is known. Of a column that is a smaller part of the longest one
/// the posture of joints that stand may be the only cause.
inline constexpr double kKnownPosture = 1e-3;

/// Reciprocal lengths of columns, where those that a posture hides have the longest one's: sizes of
/// parameters in these units are alike, however well their columns are hidden.
/// @param unit  (n) of unit_scale()
inline Eigen::VectorXd scale_of_postures(const Eigen::VectorXd& unit) {
  if (unit.size() == 0) return unit;
  const double least = unit.minCoeff();
  return unit.unaryExpr([=](double s) { return s * kKnownPosture > least ? least : s; });
}

}  // namespace dyngen::runtime
