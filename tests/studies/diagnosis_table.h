// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/studies/diagnosis_score.h"

namespace dyngen::test {

/// A rate with its uncertainty.
struct Rate {
  int hits = 0, of = 0;

  void add(bool hit) {
    hits += hit ? 1 : 0;
    ++of;
  }
  /// Ends of the 95 % interval, 0 .. 1; 0 and 1 of nothing.
  /// Source: Clopper and Pearson, "The use of confidence or fiducial limits illustrated in the case
  /// of the binomial", Biometrika 1934.
  [[nodiscard]] double low() const;
  [[nodiscard]] double high() const;
  /// "95 % (19/20, 75 to 100)"
  [[nodiscard]] std::string text() const;
};

/// Everything that the scores say, as markdown: rates by strength and by noise, the confusion
/// matrix whole, the baselines, and each failure with its seed.
std::string tables(const std::vector<CaseScore>& scores);

}  // namespace dyngen::test
