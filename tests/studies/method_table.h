// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/studies/repetition.h"

namespace dyngen::test {

struct StudyPlan {
  int repetitions = 20;
  unsigned first_seed = 1;  ///< repetition r has the seed first_seed + r, for motion and noise
  MotionPlan motion;
};

/// Median; NaN of nothing.
double median(std::vector<double> values);

/// One method over all repetitions.
struct MethodSummary {
  std::string name;
  std::vector<double> torque_errors, errors, covered, textbook_covered, seconds, p_values;
  std::vector<double> conditions, parameter_errors;
  void add(const MethodScore& score);
  [[nodiscard]] double coverage() const;  ///< mean over the repetitions
};

/// Markdown: every method over all repetitions.
void print_methods(const StudyRobot& robot, const StudyPlan& plan);

/// Markdown: coverage of ls, wls and iv if single sources of error are taken away.
void print_causes(const StudyRobot& robot, const StudyPlan& plan);

}  // namespace dyngen::test
