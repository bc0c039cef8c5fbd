// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "gen/program/program.h"

/// Calls of a program, as both evaluators compute them.
namespace dyngen::scalar {

/// -1, 0 or 1.
inline double sign(double x) { return static_cast<double>((x > 0.0) - (x < 0.0)); }

/// The first operand decides where one is no number, as in the emitted code.
inline double min(double a, double b) { return a < b ? a : b; }
inline double max(double a, double b) { return a > b ? a : b; }

constexpr double kFarthest = 1e5;  // rad: up to there a reduction leaves all bits right

/// sin(x + turn pi/2), |x| < kFarthest, within 1 ulp. Reduction by pi/2 in three parts (Cody and
/// Waite 1980), coefficients of fdlibm (Sun Microsystems 1993). The statements are those that
/// gen/emit_c/inline_trig.cpp writes as C; compiled_test.cpp holds the two against each other.
inline double turned_sine(double x, std::int64_t turn) {
  constexpr double kWhole = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer
  const double sum = x * 0.6366197723675814 + kWhole;
  const double k = sum - kWhole;
  const double r0 = x - k * 1.5707963267341256;  // exact
  const double p = k * 6.077100506303966e-11;    // exact
  const double r = r0 - p;
  const double t = ((r0 - r) - p) - k * 2.0222662487959506e-21;  // x - k pi/2 = r + t
  const double z = r * r, w = z * z;
  const double s3 = z * 1.58969099521155010221e-10 - 2.50507602534068634195e-08;
  const double s2 = z * 2.75573137070700676789e-06 - 1.98412698298579493134e-04;
  const double s1 = z * 8.33333333332248946124e-03 - 1.66666666666666324348e-01;
  const double c3 = 2.08757232129817482790e-09 - z * 1.13596475577881948265e-11;
  const double c2 = 2.48015872894767294178e-05 - z * 2.75573143513906633035e-07;
  const double c1 = 4.16666666666666019037e-02 - z * 1.38888888888741095749e-03;
  const double h = 0.5 * z, u = 1.0 - h;
  const double sine = r + (t * u + z * r * (s1 + w * (s2 + w * s3)));
  const double cosine = u + (((1.0 - u) - h) - r * t + w * (c1 + w * (c2 + w * c3)));
  // the last bits of sum are those of k: the quadrant
  const std::int64_t quadrant = std::bit_cast<std::int64_t>(sum) + turn;
  const std::int64_t s = std::bit_cast<std::int64_t>(sine), c = std::bit_cast<std::int64_t>(cosine);
  const std::int64_t chosen = s ^ ((s ^ c) & -(quadrant & 1));
  return std::bit_cast<double>(chosen ^ ((quadrant & 2) << 62));
}

/// Beyond kFarthest, and of what is no number, those of the C library.
inline double sine(double x) { return std::abs(x) < kFarthest ? turned_sine(x, 0) : std::sin(x); }
inline double cosine(double x) { return std::abs(x) < kFarthest ? turned_sine(x, 1) : std::cos(x); }

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
      return sine(a);
    case Instruction::Op::kCos:
      return cosine(a);
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
