// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "runtime/diagnosis/equation_sets/diagnosis_input.h"
#include "runtime/diagnosis/equation_sets/division.h"
#include "runtime/diagnosis/equation_sets/stiction_joint.h"
#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Which equations a diagnosis makes of recordings: up to a part of the cut-off, above which the
/// joint state that they are computed from is damped. Noise has one model for all: recordings that
/// would have more equations a second than the median of those that the model is fitted to have as
/// many as that one.
/// @param train  recordings that the model is fitted to  @param decimation  as in RowOptions
RowOptions diagnosis_rows(const std::vector<MotionSource>& train, Eigen::Index decimation);

/// Which equations of the recordings are used.
struct EquationSetOptions {
  RowOptions rows;
  /// Joints with stiction at their reversals, which have no equations there.
  std::vector<StictionJoint> sticking{};
  /// Whether the joint state passes as quick a filter as can be.
  bool quick = false;
  /// Of the sampling frequency: such a filter's highest cut-off, of all recordings alike.
  double highest = 0;
  EquationRules rules{};
  /// Joints without equations: nothing is said of them. From 0, ascending.
  std::vector<int> masked{};
};

/// The equation set of recordings whose joints stick. In a stiction interval friction may take any
/// value up to its breakaway level, so no equation judges it there. A joint that breaks away
/// excites transients, which a slow low-pass filter distorts. The joint state therefore passes the
/// quickest possible filter, and the equations one of half its bandwidth, in which the first one
/// does not damp. Where the digits of periods repeat, the state stays slow: no other motion
/// separates such rounding from physics.
/// @param train  recordings that the model is fitted to
EquationSetOptions beside_stiction(const EquationSetOptions& options,
                                   const std::vector<MotionSource>& train,
                                   std::vector<StictionJoint> sticking);

/// Recordings without the equations of joints near the stiction intervals of any recording.
/// @param sources  that `data` was made of       @param options  whose rows it has
EffectRecordings away_from_stiction(EffectRecordings data, const std::vector<MotionSource>& sources,
                                    const EquationSetOptions& options);

/// (n) the part of each joint's equations that counts.
Eigen::VectorXd counted_part(const EffectRecordings& data);

/// Equations of recordings that are not fitted, without those of joints at standstill, or in
/// stiction in any of the fitted ones.
EffectRecordings equations_of(const DiagnosisInput& input, const std::vector<MotionSource>& sources,
                              const EquationSetOptions& options);

/// The equation sets of a diagnosis. Where the fitted motion repeats, the columns of a period are
/// made from the mean motion of the other periods (instrument). Where it does not, columns come
/// from samples of even number, and residuals from those of odd number. Columns and residuals of
/// the same samples share the noise of positions, which looks like physics (instrumental variables;
/// Janot, Vandanjon and Gautier 2014).
///
/// Where joints stick, `train` has none of their equations near stiction intervals, as far as
/// filters reach. `beside` has them, and EffectRun::unknown marks the samples with unknown
/// friction: most of the residual near a stiction interval is not stiction.
struct EquationSets {
  EffectRecordings train;                  ///< for fits and for the noise
  std::optional<EffectRecordings> beside;  ///< where joints stick and equations are filtered
  [[nodiscard]] const EffectRecordings& evidence() const { return beside ? *beside : train; }
  EffectRecordings heldout;  ///< EffectRun::recording is -1 less the place of the recording
  EffectRecordings proof;    ///< what is held out, where the fitted recordings have been
  EffectRecordings slow;     ///< the fitted ones again, in half the band: the half_band
};

/// Takes the equations of joints out of all sets. @param joints  from 0
void leave_out_joints(EquationSets& sets, const std::vector<int>& joints);

EquationSets equation_sets_of(const DiagnosisInput& input, const Division& parts,
                              const EquationSetOptions& options);

}  // namespace dyngen::runtime
