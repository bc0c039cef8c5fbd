// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

inline constexpr Eigen::Index kSincReach = 16;  ///< samples of shifted() on each side
/// Of the sampling frequency: up to here of_every_other() keeps a signal.
inline constexpr double kHighestOfHalf = 0.2;

/// x(t + shift) of a band-limited signal: interpolation by a windowed sinc of 32 samples, which
/// needs 16 of them on both sides; beyond its ends the signal is continued as constant.
/// @param shift  in samples
Eigen::VectorXd shifted(const Eigen::VectorXd& x, double shift);

/// Signals as every other sample knows them: those samples stay, the others are interpolated from
/// them alone. A signal is the same up to a fifth of its sampling frequency.
/// Noise of the other samples is in no value, but where there is nothing to interpolate from: the
/// first or last sample.
/// @param x       (N x m)   @param parity  0: the first, third, ... stay; 1: the second, ...
Eigen::MatrixXd of_every_other(const Eigen::MatrixXd& x, int parity);

}  // namespace dyngen::runtime
