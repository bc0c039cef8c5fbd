// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/effects/effect_constraints.h"
#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// An effect that competes: its torque is linear in some parameters once the others stand.
struct Hypothesis {
  EffectInstance effect;    ///< shapes at a trial value; linear parameters at their typical size
  std::vector<int> linear;  ///< places of the linear parameters (of an effect that has none: of its
                            ///< shapes, made linear at the typical values)
  std::vector<int> shapes;  ///< places of what is tried: shapes and scanned parameters
  bool held = true;         ///< no state depends on the linear parameters
  bool windowed = false;    ///< what is scanned is when it begins and ends
  bool fast = false;        ///< may turn between two equations: needs all samples of the motion
  bool ordered = false;     ///< what is scanned is how often it repeats in a turn of the joint
};

/// @param scales  at the model's present estimate
Hypothesis hypothesis_of(const EffectInstance& effect, const EffectScales& scales);

/// Whether it is an error of a joint's position that repeats with the position.
bool is_position_error(const Hypothesis& hypothesis);

/// How many values of a scanned parameter are tried between its bounds.
int grid_values(const EffectParameter& scanned);

/// Trial values of the shapes: a grid between the bounds, around the typical values. The shapes of
/// each entry, in the order of Hypothesis::shapes.
std::vector<Eigen::VectorXd> shape_grid(const Hypothesis& hypothesis, const EffectScales& scales,
                                        int values);

/// With other shapes. @param shapes  in the order of Hypothesis::shapes
EffectInstance with_shapes(const Hypothesis& hypothesis, const Eigen::VectorXd& shapes);

/// A hypothesis at given shapes, beside the model.
struct TrialScore {
  Score score;
  EffectInstance effect;      ///< with the parameters that fit best
  bool admissible = true;     ///< bounds, requirements and falsifiers hold
  std::string objection;      ///< which does not
  Eigen::VectorXd typical;    ///< (linear) sizes less those at which there is no effect
  double typical_lambda = 0;  ///< noncentrality of the typical size
  std::vector<double> few;    ///< squares_of_few() of the linear parameters
  double part = 1;            ///< of all joints' equations: those in which an event acts
  double unusual = 0;         ///< chi-square that values beyond their usual ranges cost

  /// Squares that it explains, less what its values cost: what shapes are chosen by.
  [[nodiscard]] double priced() const { return score.delta_chi2 - unusual; }
};

/// Chi-square that the values of an effect cost which are beyond their usual ranges: its prior odds
/// (PriorRules). Such values are possible, and rare.
double price_of_unusual(const EffectInstance& effect, const EffectScales& scales,
                        const PriorRules& priors);

/// Whitened columns of the linear parameters at given shapes.
JointColumns hypothesis_columns(const EffectRecordings& data, EffectSignals& signals,
                                const EvidenceSystem& system, const Hypothesis& hypothesis,
                                const EffectInstance& trial);

/// @param surrogates  whether the score has those
/// @throws MissingSignalError  if a recording lacks what the effect reads
TrialScore try_hypothesis(const EffectRecordings& data, EffectSignals& signals,
                          const EvidenceSystem& system, const Hypothesis& hypothesis,
                          const EffectInstance& trial, const EffectScales& scales, bool surrogates);

/// Several trials at once, which is faster.
std::vector<TrialScore> try_shapes(const EffectRecordings& data, EffectSignals& signals,
                                   const EvidenceSystem& system, const Hypothesis& hypothesis,
                                   const std::vector<EffectInstance>& trials,
                                   const EffectScales& scales, bool surrogates);

}  // namespace dyngen::runtime
