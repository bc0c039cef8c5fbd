// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "runtime/diagnosis/equation_sets/diagnosis_input.h"
#include "runtime/diagnosis/names/findings.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

struct DiagnosisOptions {
  double false_alarm = 0.002;  ///< of the whole diagnosis, 0 .. 0.5
  int most_findings = 12;      ///< the answer says where the search ended by it
  /// Work that the search may do, in 1e9 multiplications (WorkCount); 0: as much as it needs. What
  /// the model alone leaves is looked at in any case.
  double effort = 0;
  /// The regressor's parameters are not fitted: torque is what another simulator left unexplained.
  bool residual_only = false;
  Eigen::Index decimation = 0;  ///< as RowOptions
  std::uint64_t seed = 20261121;
  DecisionRules rules;

  /// @throws std::invalid_argument  naming the option and its range
  void validate() const;
};

/// Told the stage's name and how far it is, 0 .. 1.
using DiagnosisProgress = std::function<void(const std::string& stage, double done)>;

/// What a diagnosis ended with, for who draws it.
struct DiagnosedRecordings {
  const Diagnosis& answer;
  const EffectRecordings& train;
  const EffectRecordings& heldout;
  EffectPoint before;  ///< the model alone; where there is a reference, fitted to that
  EffectPoint after;   ///< with the findings; states begin as their laws say
  std::vector<std::string> heldout_names;
};
/// Told at the end of a diagnosis that had data enough; what it is shown is gone afterwards.
using DiagnosisObserver = std::function<void(const DiagnosedRecordings& recordings)>;

/// Locates the mismatch between a model and recordings, names the physics that was left out, fits
/// it, and says what the data cannot decide. The same input gives the same answer.
/// @throws std::invalid_argument  if recordings do not fit the model
Diagnosis diagnose(const DiagnosisInput& input, const DiagnosisOptions& options = {},
                   const DiagnosisProgress& progress = {}, const DiagnosisObserver& observer = {});

}  // namespace dyngen::runtime
