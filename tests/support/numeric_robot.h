// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace dyngen::test {

/// One joint and its link, as numbers, in the file's own frames.
struct NumericJoint {
  int sigma = 0;                              ///< 0 revolute, 1 prismatic, 2 fixed
  int parent = 0;                             ///< 1-based, 0 is the base
  double alpha = 0, d = 0, theta = 0, r = 0;  ///< rad, m
  /// XX XY XZ YY YZ ZZ MX MY MZ M, about the origin and in the axes of the joint's frame (the
  /// distal one if the robot is `standard`); kg m^2, kg m, kg
  std::array<double, 10> inertial{};
  double IA = 0, Fs = 0, Fv = 0, off = 0;
};

/// A robot as plain numbers: what the judge of the generated code works on.
struct NumericRobot {
  bool standard = false;  ///< distal frames, joint i about z of its parent's frame; else modified
  std::vector<NumericJoint> joints;           ///< parents before children
  std::array<double, 3> base_acceleration{};  ///< gx gy gz = -g in frame 0, m/s^2

  [[nodiscard]] std::size_t size() const { return joints.size(); }
};

}  // namespace dyngen::test
