// SPDX-License-Identifier: MIT
// What sensors add.
#pragma once

#include <functional>

#include "tests/blind/simulation/random.h"
#include "tests/blind/simulation/tree.h"

namespace blind {

enum class Colour { kWhite, kAutoregressive, kMixed, kPink };

struct Noise {
  Colour colour = Colour::kWhite;
  double memory = 0.9;        ///< coefficient of the autoregressive part
  Eigen::VectorXd deviation;  ///< (j) of the torque, N m
  int bits = 18;              ///< of the encoders, per turn

  double digit() const { return 2 * 3.14159265358979323846 / std::exp2(bits); }  ///< rad
};

/// A torque that wanders with the time: deviation 1, smooth, forgotten over `memory` seconds.
/// @param from, to  s, between which it is defined; before and after it keeps its value
std::function<double(double t)> wandering(double memory, double from, double to, Random random);

/// Noise of the recorded torque, (N x j).
Eigen::MatrixXd torque_noise(const Noise& noise, Eigen::Index samples, Random random);

}  // namespace blind
