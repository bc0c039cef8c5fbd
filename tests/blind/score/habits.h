// SPDX-License-Identifier: MIT
// Answers by the habit of recording, and answers to crowds of effects.
#pragma once

#include <string>
#include <vector>

#include "tests/blind/score/score.h"

namespace blind {

/// A row for each habit, in the order of their names; empty where all cases are of one habit.
std::string habit_table(const std::vector<Judged>& all);

/// Pairs of family and joint in answers to crowds.
struct CrowdCount {
  int strong = 0;         ///< effects of lambda 200 and more
  int named = 0;          ///< of these, the first name of a finding on its joint
  int among = 0;          ///< of these, among the names of a finding on its joint
  int findings = 0;       ///< in all answers
  int right = 0;          ///< findings whose first name and joint are an effect's, of any lambda
  int spurious = 0;       ///< findings that have no effect's family among their names on its joint
  double gap_closed = 0;  ///< held out, median of the cases
};

/// Each effect belongs to one finding at most, each finding to one effect.
CrowdCount count_crowds(const std::vector<Judged>& all);

/// Markdown; empty where there is no crowd.
std::string crowd_table(const std::vector<Judged>& all);

}  // namespace blind
