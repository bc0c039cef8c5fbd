// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/diagnosis/changes/session_equations.h"
#include "runtime/diagnosis/equation_sets/diagnosis_input.h"
#include "runtime/diagnosis/scans/hypothesis.h"

namespace dyngen::runtime {

/// Something that may have changed after the reference; or an effect of both sides, that the model
/// lacks and that is no change.
struct ChangeCandidate {
  enum class Kind { kFriction, kLoad, kInertia, kEffect };
  Kind kind = Kind::kEffect;
  EffectInstance effect;        ///< parameters: those of a hypothesis; its linear ones are changes
  std::vector<int> parameters;  ///< places in effect.parameters of what changes
  std::vector<int> base;        ///< of each the parameter of the model that it is; -1: none
  Eigen::MatrixXd columns;      ///< (K x parameters) of later sessions: combinations of columns
  std::vector<std::vector<int>> forms;  ///< sets of these parameters that change together
  std::vector<std::string> families;    ///< its own first, then those with the same columns
  std::string formula;                  ///< empty: that of the effect's file
  bool both_sides = false;              ///< acts in the reference too, with the same size
  Eigen::VectorXd least, most;          ///< (parameters) that sizes can have; empty: any
};

/// Whether both are one effect, on one joint or link.
bool is_same_effect(const EffectInstance& a, const EffectInstance& b);

/// Columns beside the regressor that candidates need, and the candidates.
struct ChangeCandidates {
  JointColumns further;     ///< over the equations of all runs
  Eigen::Index shared = 0;  ///< the first of them belong to both sides: effects of both
  std::vector<ChangeCandidate> all;
};

/// What may have changed: friction, offset and rotor inertia of each joint, inertial parameters of
/// each link, a load on each link, a linear effect of the catalogue, an effect that was found in
/// the later recordings.
/// @param data     recordings of both sides
/// @param later    of each run whether it is after the reference
/// @param input    its loads, and what its hypotheses say of links
/// @param effects  linear effects that may have come
/// @param point    with effects that both sides are explained with
ChangeCandidates change_candidates(const EffectRecordings& data, const std::vector<bool>& later,
                                   const DiagnosisInput& input,
                                   const std::vector<Hypothesis>& effects,
                                   const EffectPoint& point);

}  // namespace dyngen::runtime
