// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/diagnosis/names/findings.h"
#include "runtime/diagnosis/scans/hypothesis.h"

namespace dyngen::runtime {

/// Where an effect shows, and how much of it is on each joint.
struct LocatedEffect {
  EffectLocation where;
  int joint = 0;            ///< on which most of it is, from 0: that of where
  Eigen::VectorXd squares;  ///< (n) whitened, less what the model absorbs
};

/// The variable in which the energy of an effect, less what the model absorbs, lies closest
/// together: the range that takes the smallest part of the samples for 70 % of it. Its share is
/// that of the effect's own energy.
/// @param effect  at its estimate, beside the system
LocatedEffect located(const EffectRecordings& data, EffectSignals& signals,
                      const EvidenceSystem& system, const Hypothesis& hypothesis,
                      const EffectInstance& effect);

}  // namespace dyngen::runtime
