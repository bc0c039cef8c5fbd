// SPDX-License-Identifier: MIT
// A pendulum as the examples see it: inertia * ddq + moment * 9.81 sin(q) + viscous * dq = tau. In
// a program of yours these functions are what dyngen wrote of a robot file.
#pragma once

#include <cmath>
#include <initializer_list>
#include <numbers>

namespace pendulum {

inline constexpr double kInertia = 0.8, kMoment = 1.2, kViscous = 0.3, kGravity = 9.81;

inline void gravity(const double* q, double* tau) { tau[0] = kMoment * kGravity * std::sin(q[0]); }
inline void friction(const double* dq, double* tau) { tau[0] = kViscous * dq[0]; }
inline void rigid(const double* q, const double*, const double* ddq, double* tau) {
  gravity(q, tau);
  tau[0] += kInertia * ddq[0];
}
inline void id(const double* q, const double* dq, const double* ddq, double* tau) {
  rigid(q, dq, ddq, tau);
  tau[0] += kViscous * dq[0];
}
inline void coriolis(const double*, const double*, double* tau) { tau[0] = 0; }

/// Parameters: inertia, moment, viscous friction.
inline void base_regressor(const double* q, const double* dq, const double* ddq, double* Y) {
  Y[0] = ddq[0];
  Y[1] = kGravity * std::sin(q[0]);
  Y[2] = dq[0];
}

/// A motion of two sines, rad and s.
struct State {
  double q = 0, dq = 0, ddq = 0;
};
inline State motion_at(double time) {
  State state;
  for (const int harmonic : {1, 3}) {
    const double w = 2 * std::numbers::pi * 0.2 * harmonic, size = 0.8 / harmonic;
    state.q += size * std::sin(w * time);
    state.dq += size * w * std::cos(w * time);
    state.ddq -= size * w * w * std::sin(w * time);
  }
  return state;
}

}  // namespace pendulum
