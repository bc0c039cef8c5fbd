// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>

#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

/// Whether samples were taken when their stamps say, or evenly, and stamped late or early.
struct ClockChoice {
  bool rebuilt = false;   ///< an even clock fits the signals better than the stamps
  double step = 0;        ///< s, of the even clock
  Eigen::VectorXd time;   ///< (N) s, of the even clock; samples that were lost leave their gap
  double advantage = 1;   ///< error of the worse clock over that of the better one
  std::string message;    ///< which, and why
};

/// Compares both clocks of a recording whose stamps are not even. Of each signal it is predicted
/// what a sample is from two on either side (Lagrange's cubic at the clock's times), and, where
/// velocities are recorded, what a step of the position is (trapezoid). The stamps are believed
/// unless the even clock's errors are smaller by kClearAdvantage.
///
/// The even clock goes through the middle of the stamps (median over kClockWindow samples), so that
/// samples which were lost are found by a whole number of steps.
ClockChoice choose_clock(const Recording& recording);

}  // namespace dyngen::runtime
