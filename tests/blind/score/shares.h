// SPDX-License-Identifier: MIT
// What counts and chance say: intervals of shares, and what the best of all tests would detect.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace blind {

/// A share that was counted, and Clopper and Pearson's interval of 95 %.
struct Share {
  int right = 0, of = 0;
  double low = 0, high = 1;

  double value() const { return of > 0 ? static_cast<double>(right) / of : 0; }
};
Share share_of(int right, int of);

/// "27 of 30, 90.0 % (73.5 to 97.9)"; "none" of nothing.
std::string text_of(const Share& share);

/// Family-wise level of false alarms, and hypotheses that share it evenly (Bonferroni): those that
/// stand behind the numbers that the suite is to reach.
constexpr double kLevel = 0.01;
constexpr int kHypotheses = 200;

constexpr double kOracleLevel = kLevel / kHypotheses;  ///< of each
/// Of each test of a diagnosis: one robot in 500 accused, some 10 000 independent tests.
constexpr double kDiagnosisLevel = 0.002 / 10000;

/// Power of the likelihood-ratio test that knows the form of what was left out and the noise: a
/// chi-square of some degrees of freedom, noncentral by lambda.
/// @param degrees  free parameters of the form, 1 and more
/// @param level    probability of a false alarm
double oracle_power(double lambda, int degrees, double level = kOracleLevel);

/// Where that power is reached. @param power  above the level, below 1
double oracle_lambda(double power, int degrees);

/// Detected shares at rising lambda, made to rise (pool of adjacent violators), and the lambda at
/// which half is detected, in a line over log lambda. NaN where all or none of them is above half.
/// @param steps  lambda, rising, and the share found
double half_detected(const std::vector<std::pair<double, Share>>& steps);

}  // namespace blind
