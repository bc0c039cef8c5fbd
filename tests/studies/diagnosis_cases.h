// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "runtime/diagnosis/diagnosis.h"
#include "runtime/effects/absorption.h"
#include "tests/studies/diagnosis_motion.h"
#include "tests/studies/foreign_torque.h"

namespace dyngen::test {

enum class CaseKind { kNull, kSingle, kPair, kTheorem, kUnknown, kTimeLocal };
enum class CaseNoise {
  kWhite,
  kMixed,      ///< half of the variance white, half AR(1) with 0.9
  kSlow,       ///< AR(1) with 0.95
  kClosedLoop  ///< mixed, and the encoder's rounding goes through the controller
};

/// "null", "white", ...: as they stand in tables and on command lines.
std::string case_name(CaseKind kind);
std::string case_name(CaseNoise noise);
/// @throws std::invalid_argument  naming what is expected
CaseKind case_kind(const std::string& name);
CaseNoise case_noise(const std::string& name);

/// What is asked of the generator of cases. The same request gives the same case.
struct CaseRequest {
  CaseKind kind = CaseKind::kSingle;
  unsigned seed = 1;
  std::string robot = "puma3";
  double lambda = 80;              ///< noncentrality of each effect
  std::optional<CaseNoise> noise;  ///< none: by the seed
  std::string family;              ///< of the first effect; empty: any
};

/// An effect that is in the data.
struct TrueEffect {
  runtime::EffectInstance effect;  ///< with its numbers
  double lambda = 0;               ///< noncentrality of what a refit of the model leaves
  double absorbed = 0;             ///< part of its squares that a refit takes up
  int recording = -1;              ///< training recording that it is in; -1: all, and the held-out
  /// Largest part of its squares that an effect of another family can imitate, and which.
  double likeness = 0;
  std::string likest;

  /// No other family comes so near that it could not be told apart.
  [[nodiscard]] bool separable() const { return lambda * (1 - likeness) >= 20; }
};

/// Recordings of a machine, and the truth of them.
struct DiagnosisCase {
  CaseRequest request;
  CaseNoise noise_kind = CaseNoise::kWhite;
  CaseSettings settings;
  CaseRobot robot;
  std::vector<TrueEffect> truth;
  std::optional<ForeignTorque> foreign;
  double foreign_lambda = 0;
  runtime::DiagnosisInput input;
  runtime::AtlasNoise noise;  ///< behind the parallel filter, of the truth

  /// "stribeck 2 + dahl 1", "null", ...
  [[nodiscard]] std::string truth_text() const;
};

/// The laws of the catalogue, made once.
const std::vector<runtime::EffectLaw>& all_laws();

/// Every effect where it can be: what the diagnosis is asked about. Given parameters stand at their
/// typical values, all others are NaN.
std::vector<runtime::EffectInstance> all_hypotheses(const CaseRobot& robot,
                                                    const runtime::EffectScales& scales);

/// Families that no motion shows beside the base model.
const std::vector<std::string>& theorem_laws();

/// Options with which recordings become motions; those of the tool for effects.
runtime::MotionOptions case_motion_options();

/// @param with_likeness  whether the truth's nearest other family is looked for (some seconds)
/// @throws std::runtime_error  if no effect can be given the strength in 60 tries
DiagnosisCase make_case(const CaseRequest& request, bool with_likeness = true);

}  // namespace dyngen::test
