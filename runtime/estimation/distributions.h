// SPDX-License-Identifier: MIT
#pragma once

namespace dyngen::runtime {

/// P(|T| > t) of Student's distribution. @param degrees  > 0
double student_tails(double t, double degrees);

/// The t with P(|T| <= t) = confidence. @param confidence  in (0, 1)
/// @throws std::invalid_argument
double student_interval(double confidence, double degrees);

/// P(X > x) of the chi-square distribution. @param degrees  > 0
double chi_square_tail(double x, double degrees);

/// P(F > f) of the ratio of two mean squares (Fisher's F). @param above, below  degrees, > 0
double variance_ratio_tail(double f, double above, double below);

}  // namespace dyngen::runtime
