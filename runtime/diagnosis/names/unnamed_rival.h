// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>

#include "runtime/diagnosis/competition/competition_result.h"

namespace dyngen::runtime {

/// What has no name and comes nearest to a winner: a function of the motion, or the form of an
/// effect that a bound or a falsifier rules out.
struct UnnamedRival {
  /// "a function of qd1 and qd2, which is no effect of the catalogue", "the form of
  /// link_flexibility 2, no name here since ..."
  std::string what;
  double net = -std::numeric_limits<double>::infinity();  ///< chi-square reduction less the penalty
  JointColumns columns{};                                 ///< whitened
  Nameless form{};                                        ///< with its score in the winner's place
};

/// Of what was strong in the winner's round, on one of its joints, what is best in its place.
/// Joints with stiction have none: the residual of stiction resembles many functions.
/// A form that the winner imitates is none: it is the same curve.
/// @param found   the winner, with its latest shapes   @param system  the model with all others
UnnamedRival unnamed_rival(const EffectRecordings& data, EffectSignals& signals,
                           const std::vector<Hypothesis>& hypotheses,
                           const CompetitionResult& result, const Winner& winner,
                           const EffectInstance& found, const EvidenceSystem& system);

}  // namespace dyngen::runtime
