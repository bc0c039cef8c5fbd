// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/effects/effect_recordings.h"
#include "runtime/effects/effect_signals.h"

namespace dyngen::runtime {

/// Columns of the equations of some joints; those of all other joints are zero.
struct JointColumns {
  std::vector<int> joints;             ///< ascending
  std::vector<Eigen::MatrixXd> parts;  ///< of each joint: (equations over all runs x columns)

  [[nodiscard]] Eigen::Index columns() const { return parts.empty() ? 0 : parts.front().cols(); }
};

/// Columns of one joint, moved into their place: a list of matrices in braces would copy them.
JointColumns columns_of_joint(int joint, Eigen::MatrixXd part);

/// Columns of several sets, in their order, with the joints of all of them; those of joints that a
/// set lacks are 0.
JointColumns side_by_side(const std::vector<JointColumns>& sets);

/// Torque of an effect and its derivatives by parameters, behind the parallel filter; equations
/// that do not count are 0. Columns: 1 + np, or only those of `wanted` (0: the torque, 1 + k: by
/// parameter k).
/// @param states_held  as of EffectWanted
/// @throws MissingSignalError  if a recording lacks what the effect reads
JointColumns effect_columns(const EffectRecordings& data, EffectSignals& signals,
                            const EffectInstance& effect, const std::vector<int>& wanted,
                            bool states_held = false);

/// Samples for one equation where a first look is enough.
inline constexpr Eigen::Index kThinnedSamples = 4;

/// The recordings with fewer samples of the motion, and the parallel filter that belongs to them.
/// Equations stay as they are.
/// @param longest  s: samples of a run become as long as the decimation divides into parts of one
///                 length, and no longer
EffectRecordings thinned(EffectRecordings data, double longest);
/// With kThinnedSamples for an equation, where the decimation is a multiple of that: what a first
/// look at an effect without memory needs.
EffectRecordings thinned(const EffectRecordings& data);

}  // namespace dyngen::runtime
