// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/effects/effect_recordings.h"

namespace dyngen::test {

/// What a simple method says of recordings.
struct BaselineResult {
  struct Name {
    std::string family;
    int joint = 0;  ///< from 1; 0: the whole robot
  };
  std::string baseline;
  std::vector<Name> names;      ///< the strongest first, each once
  Eigen::VectorXd heldout_rms;  ///< (n) N m or N, at every sample, as a diagnosis states it
};

/// "base"       the base model, joints weighted by what it leaves
/// "lasso", "sindy", "forward"  effects of the catalogue as columns at typical shapes, chosen by
///              lasso(), thresholded(), forward(); their amounts and the base model fitted again
/// "spline"     of what the base model leaves of a joint: cubic splines of its position and of its
///              speed, added up, ridge regression; its penalty by the last fitted recording
/// "ladder"     friction_ladder() of each joint by the last fitted recording; amounts and the base
///              model fitted again
/// All take noise as white.
/// @param train       two recordings at least
/// @param hypotheses  their parameters are not read
/// @throws std::invalid_argument  if there is one recording only
std::vector<BaselineResult> baseline_results(
    const runtime::EffectRecordings& train, const runtime::EffectRecordings& heldout,
    const std::vector<runtime::EffectInstance>& hypotheses);

}  // namespace dyngen::test
