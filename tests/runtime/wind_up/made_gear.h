// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "runtime/wind_up/wind_up.h"

namespace dyngen::test {

/// A gear whose every number is known, and the motion that it is seen in.
struct MadeGear {
  double seconds = 30, rate = 125;
  double delay = 0;             ///< s by which ql is late
  double compliance = 0;        ///< rad/(N m)
  double hardening = 0;         ///< rad/(N m)^3
  double hysteresis = 0;        ///< rad, between both directions of motion
  double gap = 0;               ///< rad
  double order = 0, error = 0;  ///< of a gear error: periods per turn; amplitude, rad
  double slow_error = 0;        ///< rad, of a cubic over the travel
  double noise = 2e-6;          ///< rad, of the difference of both encoders
  double noise_memory = 0.9;    ///< of a sample on the next
  double offset = 3e-3;         ///< rad
  double bias = 0;              ///< N m of the load: it keeps its sign where that is large
  double rotor = 0;             ///< kg m^2 that is in the load's model and not in the load
  bool by_position = false;     ///< the load is a function of the position alone
};

/// Positions are sums of sines of which derivatives are exact, the load has sines of its own.
runtime::WindUpData made_wind_up(const MadeGear& gear, std::mt19937& random);

}  // namespace dyngen::test
