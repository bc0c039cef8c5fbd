// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "runtime/effects/absorption.h"
#include "runtime/effects/effect_law.h"
#include "tests/studies/diagnosis_bench.h"
#include "tests/studies/foreign_torque.h"

namespace dyngen::test {

/// The laws of the catalogue, made once.
const std::vector<runtime::EffectLaw>& all_laws();

/// Every effect where it can be: what the diagnosis is asked about. Given parameters stand at their
/// typical values, all others are NaN.
std::vector<runtime::EffectInstance> all_hypotheses(const CaseRobot& robot,
                                                    const runtime::EffectScales& scales);

/// Families that no motion shows beside the base model.
const std::vector<std::string>& theorem_laws();

/// The effect of another family that comes nearest to a torque.
struct Nearest {
  double likeness = 0;  ///< largest part of the squares that one can imitate, 0 .. 1
  std::string family;   ///< empty: none can

  /// It comes not so near that it could not be told from a torque of this noncentrality.
  [[nodiscard]] bool separable(double lambda) const { return lambda * (1 - likeness) >= 20; }
};

/// An effect that is in the data.
struct TrueEffect {
  runtime::EffectInstance effect;  ///< with its numbers
  double lambda = 0;               ///< noncentrality of what a refit of the model leaves
  double absorbed = 0;             ///< part of its squares that a refit takes up
  int recording = -1;              ///< training recording that it is in; -1: all, and the held-out
  Nearest nearest;
};

/// Which truth is drawn.
struct TruthRequest {
  std::size_t effects = 1;
  bool time_local = false;  ///< effects that act for a part of the time, else those that always do
  unsigned seed = 1;
  double lambda = 80;          ///< noncentrality of each effect
  std::string family;          ///< of the first effect; empty: any
  bool with_likeness = false;  ///< whether the nearest other family is looked for (some seconds)
};

/// Effects of different families, each with its strength.
/// @param noise  behind the parallel filter, of the truth
/// @throws std::runtime_error  if no effect can be given the strength in 60 tries
std::vector<TrueEffect> drawn_truth(const Bench& bench, const TruthRequest& request,
                                    const runtime::AtlasNoise& noise, std::mt19937_64& random);

/// One of theorem_laws() where it is a theorem: a sine of the position is gravity's only where the
/// joint alone turns the link against gravity.
/// @throws std::runtime_error  if it shows on every joint of the robot
TrueEffect drawn_theorem(const Bench& bench, unsigned seed, const runtime::AtlasNoise& noise,
                         std::mt19937_64& random);

/// How strong a torque that is no effect is in the recordings.
struct ForeignStrength {
  double lambda = 0;  ///< noncentrality; 0: a refit takes all of it up
  double absorbed = 0;
  Nearest nearest;
};

/// Scales a foreign torque to a strength.
/// @param with_likeness  whether the nearest family is looked for (some seconds)
ForeignStrength scale_foreign(const Bench& bench, const runtime::AtlasNoise& noise, double lambda,
                              bool with_likeness, ForeignTorque& foreign);

}  // namespace dyngen::test
