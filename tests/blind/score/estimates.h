// SPDX-License-Identifier: MIT
// How near the numbers of findings are to the truth's, and whether their intervals hold it.
#pragma once

#include <string>
#include <vector>

#include "tests/blind/score/score.h"

namespace blind {

/// One number of a finding that means the same as one of the truth.
struct Estimate {
  std::string name;             ///< case, family, parameter
  bool own_form = false;        ///< of a form that is not the catalogue's: the same to first order
  double lambda = 0;            ///< of the truth
  double truth = 0, value = 0;  ///< SI
  double deviation = 0;         ///< as the finding states it; 0: it states none
  double error() const;         ///< relative to the truth; NaN where that is 0
  bool covered() const;         ///< within 1.96 deviations
};

/// Of every truth that a finding names on its joint, in a form with the same parameters.
std::vector<Estimate> estimates(const std::vector<Judged>& all);

/// Markdown; empty where there is none.
std::string estimate_table(const std::vector<Judged>& all);

}  // namespace blind
