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

/// What of recordings is looked at.
struct EquationSetOptions {
  RowOptions rows;
  /// Joints that rest for an instant where they turn, and have no equations there.
  std::vector<StictionJoint> sticking{};
  /// Whether the joint state passes as quick a filter as can be.
  bool quick = false;
  /// Of the sampling frequency: such a filter's highest cut-off, of all recordings alike.
  double highest = 0;
  EquationRules rules{};
};

/// The view of recordings whose joints, as was found, rest. Where friction holds a joint it has any
/// torque up to its own: nothing is said of it there. What lets go jolts the arm, and of jolts a
/// slow joint state is not the state: it passes a filter that is as quick as can be, and the
/// equations one half as quick, up to which the first one damps nothing. Where periods show
/// the same digits again the state stays slow: no other motion tells such rounding from physics.
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

/// Equations of recordings that are not fitted, without those of joints that stand still, or rest
/// in any of the fitted ones.
EffectRecordings equations_of(const DiagnosisInput& input, const std::vector<MotionSource>& sources,
                              const EquationSetOptions& options);

/// The recordings of a diagnosis as its competition reads them. Where the motion of fitted ones
/// repeats, columns are made of the mean motion of the other periods, and held against what the
/// model leaves at the own; where it does not, columns of the samples of even number and what is
/// left of those of odd. Noise of positions is in what is left as well as in columns of the same
/// samples, where it looks like physics (instrumental variables; Janot, Vandanjon and Gautier
/// 2014).
///
/// Where joints rest, `train` has no equations of them near their stiction intervals, as far as
/// filters reach. `beside` has them, and EffectRun::unknown says where friction is not known: most
/// of what is seen near a rest is not friction's at rest.
struct EquationSets {
  EffectRecordings train;                  ///< what fits are of, and noise
  std::optional<EffectRecordings> beside;  ///< where joints rest and equations are filtered
  [[nodiscard]] const EffectRecordings& evidence() const { return beside ? *beside : train; }
  EffectRecordings heldout;  ///< EffectRun::recording is -1 less the place of the recording
  EffectRecordings proof;    ///< what is held out, where the fitted recordings have been
  EffectRecordings slow;     ///< the fitted ones again, in half the band: the half_band
};
EquationSets equation_sets_of(const DiagnosisInput& input, const Division& parts,
                              const EquationSetOptions& options);

}  // namespace dyngen::runtime
