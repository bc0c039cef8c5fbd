// SPDX-License-Identifier: MIT
#include "runtime/estimation/distributions.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/SpecialFunctions>

namespace dyngen::runtime {

double student_tails(double t, double degrees) {
  return Eigen::numext::betainc(degrees / 2, 0.5, degrees / (degrees + t * t));
}

double student_interval(double confidence, double degrees) {
  if (!(confidence > 0 && confidence < 1 && degrees > 0)) {
    throw std::invalid_argument(fmt::format(
        "student_interval(): confidence {} and {} degrees of freedom: expected 0 < confidence < 1 "
        "and degrees > 0",
        confidence, degrees));
  }
  double low = 0, high = 1;
  while (student_tails(high, degrees) > 1 - confidence) high *= 2;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (student_tails(middle, degrees) > 1 - confidence ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double chi_square_tail(double x, double degrees) {
  if (x <= 0) return 1;
  return Eigen::numext::igammac(degrees / 2, x / 2);
}

double variance_ratio_tail(double f, double above, double below) {
  if (f <= 0) return 1;
  return Eigen::numext::betainc(below / 2, above / 2, below / (below + above * f));
}

}  // namespace dyngen::runtime
