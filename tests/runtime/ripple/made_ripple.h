// SPDX-License-Identifier: MIT
#pragma once

#include <random>

#include "runtime/ripple/ripple.h"

namespace dyngen::test {

/// How a joint moves.
enum class Sweep {
  kSines,  ///< three frequencies: the speed varies all the time
  kSpeeds  ///< ramps at constant speed, up and down
};

/// A joint whose torque is known.
struct MadeRipple {
  double seconds = 30, rate = 1000;
  Sweep sweep = Sweep::kSines;
  double reach = 5;              ///< rad between both ends, about
  double order = 0;              ///< 0: no ripple
  double lambda = 0;             ///< of the ripple beside the noise; it gives the amplitude
  double phase = 0.7;            ///< rad
  double backward = 1;           ///< amplitude backward, over that forward
  double backward_phase = 0.7;   ///< rad
  bool position_error = false;   ///< the ripple is the torque of a position error
  double noise = 0.1;            ///< N m, standard deviation of the innovations
  double memory = 0;             ///< of a sample of the noise on the next
  double slow = 0;               ///< N m, torque that the slow model leaves: friction and posture
  double line_hz = 0, line = 0;  ///< a line of fixed frequency, N m
  double resonance_hz = 0, resonance = 0;  ///< noise through a resonance of 0.5 % damping, N m rms
};

/// @return  data and, in `amplitude`, the amplitude of the ripple forward
struct RippleTruth {
  runtime::RippleData data;
  double amplitude = 0;
};
RippleTruth made_ripple(const MadeRipple& made, std::mt19937& random);

}  // namespace dyngen::test
