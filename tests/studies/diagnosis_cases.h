// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "runtime/diagnosis/diagnosis.h"
#include "runtime/effects/absorption.h"
#include "tests/studies/diagnosis_motion.h"
#include "tests/studies/diagnosis_truth.h"
#include "tests/studies/foreign_torque.h"

namespace dyngen::test {

enum class CaseKind { kNull, kSingle, kPair, kTheorem, kUnknown, kTimeLocal };
enum class CaseNoise {
  kWhite,
  kMixed,        ///< half of the variance white, half AR(1) with 0.9
  kSlow,         ///< AR(1) with 0.95
  kClosedLoop,   ///< mixed, and the encoder's error goes through the controller
  kRoundedLoop,  ///< the same, of encoders that round without noise: each period shows the same
                 ///< digits
  kPink          ///< 1/f from a sample to some minutes
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
  bool once = false;               ///< no motion repeats
};

/// Recordings of a machine, and the truth of them.
struct DiagnosisCase {
  CaseRequest request;
  CaseNoise noise_kind = CaseNoise::kWhite;
  CaseSettings settings;
  CaseRobot robot;
  std::vector<TrueEffect> truth;
  std::optional<ForeignTorque> foreign;
  ForeignStrength foreign_strength;
  runtime::DiagnosisInput input;
  runtime::AtlasNoise noise;  ///< behind the parallel filter, of the truth

  /// "stribeck 2 + dahl 1", "null", ...
  [[nodiscard]] std::string truth_text() const;
};

/// @param with_likeness  whether the truth's nearest other family is looked for (some seconds)
/// @throws std::runtime_error  if no effect can be given the strength in 60 tries
DiagnosisCase make_case(const CaseRequest& request, bool with_likeness = true);

}  // namespace dyngen::test
