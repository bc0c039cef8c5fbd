// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/identification/motion_source.h"
#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

/// One cut-off for recordings that are fitted or judged together: what spectra say
/// (choose_cutoff()), the median of the recordings, weighted by their samples. 0 Hz where none
/// leaves it open.
Cutoff median_cutoff(const std::vector<MotionSource>& sources);

/// The same, and what the model's torque says of it.
///
/// It begins with median_cutoff() and asks whether torque is predicted better behind another
/// low-pass: in steps of half an octave, from kLowestCutoff to kHighestCutoff of the sampling
/// frequency. Each trial fits the model to nine of ten blocks of consecutive samples and predicts
/// the tenth, ten times; torque is what was measured, never filtered, so that all trials answer for
/// the same numbers (blocked cross-validation: Burman, Chow and Nolan, "A cross-validatory method
/// for dependent data", Biometrika 81, 1994). The first choice stays unless the best trial leaves
/// certainly less: by a twentieth of the squares in the geometric mean of the blocks, and more than
/// blocks differ.
///
/// Speeds and accelerations that are noisy, or torque of vibration, so lower the cut-off; motion
/// that is lost raises it.
///
/// @param model    as many joints as the recordings
/// @param sources  those without `others.at` decide nothing; may be empty
/// @return         0 Hz where no source leaves the cut-off open
Cutoff common_cutoff(const LinearModel& model, const std::vector<MotionSource>& sources);

/// The sources behind that low-pass; those without `others.at` as they are.
std::vector<MotionSource> at_cutoff(const std::vector<MotionSource>& sources, const Cutoff& cutoff);

}  // namespace dyngen::runtime
