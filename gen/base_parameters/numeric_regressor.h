// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cln/real.h>
#include <ginac/ginac.h>

#include <cstdint>
#include <vector>

#include "gen/base_parameters/column.h"
#include "gen/symbols/symbolic_robot.h"

namespace dyngen {

/// Random numbers that are the same on every machine (SplitMix64; Steele, Lea, Flood 2014).
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(seed) {}
  /// A multiple of 2^-32 in [-1, 1), never 0.
  GiNaC::numeric next();

 private:
  std::uint64_t state_;
};

/// A random state of the robot, with random numbers for its unknown lengths.
struct RandomState {
  std::vector<GiNaC::numeric> q, dq, ddq;  ///< of the coordinates
};
RandomState random_state(const SymbolicRobot& robot, RandomStream& random, bool moving);

/// The robot's geometry as numbers of one arithmetic.
template <class T>
struct NumericGeometry {
  struct Link {
    JointType type;
    int parent;
    int coordinate;
    T cos_alpha, sin_alpha, cos_theta, sin_theta, d, r;
  };
  std::vector<Link> links;
  T gravity[3];
};

/// @param lengths  a number for each unknown length and gravity component of the robot
template <class T>
NumericGeometry<T> numeric_geometry(const SymbolicRobot& robot, const GiNaC::exmap& lengths);

/// Rows of the regressor at one state: coordinate_count rows, one entry per column.
///
/// Newton-Euler with unit parameters in the links' own frames (thesis 3.3.2).
/// Instantiated for long double and cln::cl_R.
template <class T>
std::vector<std::vector<T>> numeric_regressor(const NumericGeometry<T>& geometry,
                                              const RandomState& state,
                                              const std::vector<Column>& columns);

}  // namespace dyngen
