// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "tests/studies/diagnosis_cases.h"

namespace dyngen::test {

/// What a simple method names.
struct BaselineAnswer {
  std::string method;
  std::vector<std::string> families;  ///< by the squares that each takes, falling; with repeats
  std::vector<int> joints;            ///< coordinate of each; -1: the whole robot
};

/// All effects as columns at their typical shapes, joints weighted by what the base model leaves,
/// noise taken as white:
///
/// "lasso"    least squares with an absolute penalty by coordinate descent (Friedman, Hastie and
///            Tibshirani, Journal of Statistical Software 2010); the penalty by the Bayesian
///            information criterion with the number of equations
/// "forward"  the column that lowers the squares most, while an F test at 5 % and the criterion
///            with the number of equations agree
/// @param data  training recordings of the case
std::vector<BaselineAnswer> baseline_answers(const DiagnosisCase& own,
                                             const runtime::EffectRecordings& data);

}  // namespace dyngen::test
