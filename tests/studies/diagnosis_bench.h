// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/identification/motion_source.h"
#include "tests/studies/diagnosis_motion.h"

namespace dyngen::test {

constexpr std::size_t kTrainRecordings = 3;  ///< of a case; those after them are held out

/// Everything about a machine at work that does not depend on which effect is in it.
struct Bench {
  const CaseRobot& robot;
  const CaseSettings& settings;
  std::vector<runtime::Trajectory> trajectories;
  std::vector<std::uint64_t> seeds;    ///< of the encoder, one a recording
  std::vector<CaseMotion> plain;       ///< without effects
  std::vector<Eigen::MatrixXd> error;  ///< noise of the torque, (N x n)
};

/// Options with which recordings become motions; those of the tool for effects.
runtime::MotionOptions case_motion_options();

/// What a diagnosis gets of a motion: the encoder's positions, and the torque with its noise.
/// @param torque  (N x n) without noise
/// @param place   of the recording in the bench
runtime::MotionSource source_of(const Bench& bench, const CaseMotion& motion,
                                const Eigen::MatrixXd& torque, std::size_t place);

/// Training recordings without effects, with the equations of an effect that remembers at rest.
/// @param law    null: of no effect
/// @param joint  on which it acts; -1: the whole robot
runtime::EffectRecordings plain_recordings(const Bench& bench, const runtime::EffectLaw* law,
                                           int joint);

/// Torque of an effect in every training recording, on the motion as it is without it.
/// @param only  the one recording that it is in; -1: all
std::vector<Eigen::MatrixXd> torque_in(const Bench& bench, const runtime::EffectInstance& effect,
                                       int only);

}  // namespace dyngen::test
