// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/diagnosis/changes/session_equations.h"
#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/equation_sets/diagnosis_input.h"
#include "runtime/diagnosis/names/findings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Recordings before and after something may have changed.
struct ComparedSessions {
  const EffectRecordings& reference;
  const EffectRecordings& later;
  std::vector<int> later_files;  ///< of each place of a recording in `later`: its file
};

/// What changed on a robot between the reference and the later recordings.
struct ChangesSince {
  /// Their parameters are differences to the reference. They are part of the fitted model's own
  /// parameters, and so no rows of effects.
  std::vector<Finding> findings;
  std::string sessions;  ///< how far sessions differ without a change, in a sentence
};

/// Both sides' equations with common parameters, and sets of changes of the later side: parameters
/// of the model, loads that can exist, linear effects. The scatter between sessions is a part of
/// the noise.
/// @param result  of the competition on the later recordings: its effects are taken for effects of
///                both sides, unless the reference says otherwise
/// @param false_alarm  P that sessions without a change are accused
/// @throws std::invalid_argument  if the recordings do not fit together
ChangesSince changes_since(const ComparedSessions& compared, const DiagnosisInput& input,
                           const std::vector<Hypothesis>& hypotheses,
                           const CompetitionResult& result, double false_alarm,
                           const DecisionRules& rules);

/// Parameters of the model alone, fitted to the reference; combinations that it does not determine
/// are those of `start`.
Eigen::VectorXd fitted_to_reference(const EffectRecordings& reference,
                                    const Eigen::VectorXd& start);

}  // namespace dyngen::runtime
