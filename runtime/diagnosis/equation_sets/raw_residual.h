// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_rows.h"
#include "runtime/evidence/torque_noise_model.h"

namespace dyngen::runtime {

/// Recorded torque less the model with its effects, at every sample and without any filter. What
/// makes torque late moves the model's: a delay to the motion some time before, a lag by the rate
/// of what the parallel filter passes of it.
/// @return  run by run, (N x n) N m or N
RunResiduals raw_residuals(const EffectRecordings& data, const EffectPoint& point);

/// Whether a joint has equations around a sample: at standstill friction may take any value.
/// @return  (N) of the run
std::vector<bool> counted_samples(const EffectRun& run, int joint);

/// (n) rms over all samples at which a joint has equations around it.
Eigen::VectorXd raw_rms(const EffectRecordings& data, const RunResiduals& residuals);

/// (n) rms of the torque's noise: of what differs between periods where the motion repeats and the
/// joint has equations, else of the residual itself.
/// @param repeats  in equations, of repeats_of()
Eigen::VectorXd raw_floor(const EffectRecordings& data, const RunResiduals& residuals,
                          const std::vector<double>& repeats);

}  // namespace dyngen::runtime
