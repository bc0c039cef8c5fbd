// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <cmath>
#include <limits>

#include "gen/program/program.h"

/// Calls of a program that <cmath> does not have, as both evaluators compute them.
namespace dyngen::scalar {

/// -1, 0 or 1.
inline double sign(double x) { return static_cast<double>((x > 0.0) - (x < 0.0)); }

/// The first operand decides where one is no number, as in the emitted code.
inline double min(double a, double b) { return a < b ? a : b; }
inline double max(double a, double b) { return a > b ? a : b; }

/// phi(x) = (1 - exp(-x)) / x, to 2e-16 of its value: expm1 loses nothing near 0.
inline double decay_mean(double x) { return x == 0.0 ? 1.0 : -std::expm1(-x) / x; }

/// phi'(x), to 1e-15 of its value. Near 0, where the closed form subtracts equal numbers, the sum
/// of
/// (-1)^k k x^(k-1) / (k+1)!.
inline double decay_mean_slope(double x) {
  if (std::abs(x) > 1.0) return (std::exp(-x) - decay_mean(x)) / x;
  constexpr int kTerms = 18;  // the next one is below 1e-17
  double sum = 0.0;
  for (int k = kTerms; k >= 1; --k) {  // term k + 1 is -x (k + 1) / (k (k + 2)) times term k
    sum = sum * -x * (k + 1.0) / (k * (k + 2.0)) + 1.0;
  }
  return -0.5 * sum;
}

/// The value of a call. The second operand is read by those that have two.
inline double called(Instruction::Op op, double a, double b) {
  switch (op) {
    case Instruction::Op::kSin:
      return std::sin(a);
    case Instruction::Op::kCos:
      return std::cos(a);
    case Instruction::Op::kSign:
      return sign(a);
    case Instruction::Op::kMin:
      return min(a, b);
    case Instruction::Op::kMax:
      return max(a, b);
    case Instruction::Op::kPower:
      return std::pow(a, b);
    case Instruction::Op::kExp:
      return std::exp(a);
    case Instruction::Op::kLog:
      return std::log(a);
    case Instruction::Op::kTanh:
      return std::tanh(a);
    case Instruction::Op::kSqrt:
      return std::sqrt(a);
    case Instruction::Op::kDecayMean:
      return decay_mean(a);
    case Instruction::Op::kDecayMeanSlope:
      return decay_mean_slope(a);
    default:  // sums, products and absolute values are no calls
      return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace dyngen::scalar
