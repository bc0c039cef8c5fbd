// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/diagnosis/findings.h"
#include "runtime/effects/effect_recordings.h"
#include "runtime/identification/motion_source.h"

namespace dyngen::runtime {

/// What a diagnosis looks at.
struct DiagnosisInput {
  LinearModel model;
  EffectRobot robot;
  std::vector<MotionSource> train;
  std::vector<MotionSource> heldout;    ///< may be empty: then a fifth of every recording of train
  std::vector<MotionSource> reference;  ///< of the same robot before a change; may be empty
  /// Effects that compete, each on one joint, pair or the whole robot, with `link` set. Parameters
  /// that have numbers are taken as given; others are NaN.
  std::vector<EffectInstance> hypotheses;
};

struct DiagnosisOptions {
  double false_alarm = 0.01;  ///< of the whole diagnosis, 0 .. 0.5
  int most_findings = 8;
  /// The regressor's parameters are not fitted: torque is what another simulator left unexplained.
  bool residual_only = false;
  Eigen::Index decimation = 0;  ///< as RowOptions
  std::uint64_t seed = 20261121;

  /// @throws std::invalid_argument  naming the option and its range
  void validate() const;
};

/// Which equations a diagnosis makes of recordings: up to a part of the cut-off, above which the
/// joint state that they are computed from is damped. Noise has one model for all: recordings that
/// would have more equations a second than the median of those that the model is fitted to have as
/// many as that one.
/// @param train  recordings that the model is fitted to  @param decimation  as in DiagnosisOptions
RowOptions diagnosis_rows(const std::vector<MotionSource>& train, Eigen::Index decimation);

/// Told the stage's name and how far it is, 0 .. 1.
using DiagnosisProgress = std::function<void(const std::string& stage, double done)>;

/// What a diagnosis ended with, for who draws it.
struct DiagnosedRecordings {
  const Diagnosis& answer;
  const EffectRecordings& train;
  const EffectRecordings& heldout;
  EffectPoint before;  ///< the model alone
  EffectPoint after;   ///< with the findings; states begin as their laws say
  std::vector<std::string> heldout_names;
};
/// Told at the end of a diagnosis that had data enough; what it is shown is gone afterwards.
using DiagnosisWitness = std::function<void(const DiagnosedRecordings& recordings)>;

/// Locates the mismatch between a model and recordings, names the physics that was left out, fits
/// it, and says what the data cannot decide. The same input gives the same answer.
/// @throws std::invalid_argument  if recordings do not fit the model
Diagnosis diagnose(const DiagnosisInput& input, const DiagnosisOptions& options = {},
                   const DiagnosisProgress& progress = {}, const DiagnosisWitness& witness = {});

}  // namespace dyngen::runtime
