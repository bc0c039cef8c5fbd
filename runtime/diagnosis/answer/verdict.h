// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "runtime/diagnosis/competition/search.h"
#include "runtime/diagnosis/names/findings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

struct Conclusion {
  Verdict verdict = Verdict::kInsufficientData;
  std::string sentence;
};

/// Neither an effect nor structure without a name.
bool found_nothing(const CompetitionResult& result);

/// Why what the model leaves is too slow to call recordings clean: they are worth too few
/// independent samples. Empty: they are worth enough.
std::string why_too_slow(const CompetitionResult& result, const NoiseRules& rules);

/// Why recordings in which nothing was found are not clean: not everything was searched. Empty: it
/// was.
std::string why_cut_off(const CompetitionResult& result);

/// What a verdict does not speak of, in a sentence; empty: it speaks of all joints.
std::string not_judged_sentence(const std::vector<UnjudgedJoint>& unjudged);

/// @param findings  of the winners, in their order, then those since the reference
Conclusion concluded(const Search& search, const std::vector<Finding>& findings,
                     const AnswerRules& rules);

}  // namespace dyngen::runtime
