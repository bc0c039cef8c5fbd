// SPDX-License-Identifier: MIT
// What simpler methods are worth on the same cases.
#pragma once

#include <string>
#include <vector>

#include "tests/blind/score/score.h"

namespace blind {

/// One answer of one method, in terms that all have: names without probabilities.
struct JudgedBaseline {
  std::string baseline, kind;
  bool said = false;   ///< something was found
  bool names = false;  ///< the method can name anything
  bool first = false;  ///< the first name is the truth's family, on its joint
  bool among = false;  ///< a name is
  int count = 0;       ///< names
  int wrong = 0;       ///< of them, families that the truth has not
  double lambda = 0;
  double heldout = 0;  ///< rms over the oracle's, root mean square of the joints; 0: not known
};

/// Of every method in an answer; empty if it has not the schema.
std::vector<JudgedBaseline> judge_baselines(const nlohmann::json& truth,
                                            const nlohmann::json& answer);

/// A diagnosis in the same terms: a finding is wrong where no alias is the truth's family either.
JudgedBaseline as_baseline(const Judged& judged);

/// A row for each method, in the order in which they first come; Markdown.
std::string baseline_table(const std::vector<JudgedBaseline>& all);

}  // namespace blind
