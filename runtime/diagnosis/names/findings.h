// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "runtime/diagnosis/equation_sets/sufficiency.h"
#include "runtime/effects/effect_fit.h"
#include "runtime/effects/effect_law.h"

namespace dyngen::runtime {

enum class Verdict {
  kClean,         ///< nothing above the noise
  kExplained,     ///< findings explain it
  kNotExplained,  ///< held-out torque is far above the noise, or predicted worse than before
  kUnexplainedStructure,  ///< something is left that no effect explains
  kInsufficientData       ///< the recordings cannot carry a test
};

/// Where an effect shows: a range of a variable that holds most of it.
struct EffectLocation {
  std::string variable;     ///< "qd2", "q3", "tau_load2", "t", "distance2"; joints from 1
  double from = 0, to = 0;  ///< rad, rad/s, N m, s ...
  /// s: the part of the recordings in which it acts; NaN: all of it
  double t_from = std::numeric_limits<double>::quiet_NaN();
  double t_to = std::numeric_limits<double>::quiet_NaN();
  /// Of the energy that the model leaves of its joint above the noise, the part that is this effect
  /// in this range, 0 .. 1; NaN: of a change since the reference.
  double share = 0;
  bool spread = false;    ///< over all of the variable: the range is what it had
  std::string recording;  ///< in which alone it acts; empty: in all
};

/// How strongly the recordings speak for an effect.
struct Evidence {
  double lambda = 0;     ///< noncentrality of what a refit of the model does not absorb
  double delta_bic = 0;  ///< of adding it; negative is better
  /// Part by which it lowers the rms of the held-out torque of its joints: 1 less the rms of the
  /// answer over that of the answer without it, refitted
  double heldout_gain = 0;
};

/// A test that a name must pass.
struct FalsifierOutcome {
  std::string test;  ///< "vs <= 0.25*v90", "slow_steady"
  bool passed = true;
  std::string text;   ///< what was found, or what is needed
  bool known = true;  ///< false: these recordings cannot answer it
};

/// Physics that the model left out.
struct Finding {
  EffectInstance effect;  ///< with its estimate; family "unknown" never stands here
  std::vector<EffectParameterFit> parameters;
  std::vector<std::string> aliases;  ///< families that these data cannot tell apart, its own first
  /// Joints on which the same would explain it as well, and its size there; empty: none
  std::string elsewhere;
  std::string unnamed;     ///< what has no name and is not told apart either; empty: nothing
  double probability = 0;  ///< that the family is right, 0 .. 1
  bool uncertain = false;  ///< a probability below AnswerRules::probable: listed apart
  /// A change since the reference recordings: part of the model's own parameters, no row of
  /// effects.
  bool since_reference = false;
  bool doubted = false;  ///< a bound holds the estimate, or a falsifier speaks against the name
  double absorbed = 0;   ///< part of its chi-square that a refit of the model absorbs
  EffectLocation where;
  Evidence evidence;
  std::vector<FalsifierOutcome> tests;
  /// "f = 2.1 Hz: unusual, a slower oscillation is a liquid": values beyond usual ranges
  std::vector<std::string> unusual;
  /// Sentences on what the name and its numbers do not say: another form of the effect that
  /// explains it as well, a time constant that the recordings do not reach
  std::vector<std::string> caveats{};
  std::string formula;  ///< of the effect's file; empty where the caller knows it
  std::string why;      ///< one sentence
};

/// What no estimate from these data could decide.
struct Undecidable {
  std::vector<std::string> families;
  int joint = -1;  ///< coordinate, from 0; -1: the whole robot
  std::string why;
};

/// Structure without a name.
struct Unexplained {
  int joint = 0;                       ///< coordinate, from 0
  std::vector<std::string> variables;  ///< "q4", "qd4", "t", ...; joints from 1
  double rms = 0;                      ///< N m or N
  std::string description;             ///< a sentence
};

/// The smallest size at which an effect that was not found would have been.
struct CertificateLine {
  EffectInstance effect;
  int parameter = -1;
  double smallest = 0;  ///< of the parameter; inf: never
};

/// What the findings changed about a parameter of the model. `before`: as of HeldoutResidual.
struct BaseShift {
  std::string name;
  double before = 0, after = 0;
  double stddev = 0;  ///< of `after`; NaN: the recordings do not determine it alone
};

/// rms of the recorded torque less the model, of recordings that no parameter was fitted to.
/// `before`: the model alone, fitted to the training recordings; where there is a reference, to
/// that.
struct HeldoutResidual {
  Eigen::VectorXd before, after, floor;  ///< (n) N m or N; NaN: of a joint that is not judged
  /// (n) 0 .. 1: part of each joint's equations where it is within the positions of the fitted
  /// recordings. Findings are judged there alone.
  Eigen::VectorXd visited;
  std::vector<std::string> remarks{};  ///< heldout_remarks()
};

/// How large the noise of the torque is, and how that is known.
struct NoiseFloor {
  Eigen::VectorXd deviation;  ///< (n) N m or N, of the raw torque; NaN: as of HeldoutResidual
  Eigen::VectorXd correlation_time;  ///< (n) samples that are worth one
  Eigen::VectorXd worth;             ///< (n) independent samples of the equations
  bool from_periods = false;         ///< else from what model and structure leave
  std::string how;                   ///< a sentence
};

/// Strength of the test whether there is any structure.
struct StructureTest {
  int joint = 0;
  double statistic = 0, threshold = 0;
  std::string variable;  ///< in which it is strongest
};

/// What the recordings are like.
struct ConditionLine {
  std::string recording;
  std::vector<std::string> sentences;
};

/// A trajectory that would tell the names of a finding apart.
struct NextExperiment {
  std::string purpose;    ///< "separate stribeck from presliding on joint 5"; empty: none is needed
  std::string archetype;  ///< "slow both ways", ...
  int joint = -1;
  std::vector<std::string> families;
};

/// Work of the search, and what was not searched since it was bounded.
struct EffortUsed {
  double most = 0;                   ///< in 1e9 multiplications; 0: no bound
  double done = 0;                   ///< the same
  std::vector<std::string> cut_off;  ///< "pairs of effects", ...
  /// Effects that were not tried: slower than the recordings.
  std::vector<std::string> not_offered;

  /// Both.
  [[nodiscard]] std::vector<std::string> not_searched() const {
    std::vector<std::string> all = cut_off;
    all.insert(all.end(), not_offered.begin(), not_offered.end());
    return all;
  }
};

/// The answer.
struct Diagnosis {
  Verdict verdict = Verdict::kInsufficientData;
  std::string sentence;  ///< the verdict in words
  std::vector<ConditionLine> condition;
  std::vector<UnjudgedJoint> not_judged;  ///< joints of which nothing is said
  NoiseFloor noise;
  std::vector<StructureTest> before, after;  ///< of every joint: of the model alone, with findings
  std::vector<Finding> findings;
  std::vector<Undecidable> undecidable;
  std::vector<Unexplained> unexplained;
  double detectable_lambda = 0;  ///< that is found nine times in ten; 0: not known
  std::vector<CertificateLine> certificate;
  std::vector<BaseShift> base_parameters;
  HeldoutResidual heldout;
  NextExperiment next;
  EffortUsed effort;
  EffectFit fit;  ///< of the model with the findings, to the training recordings
  /// How far sessions differ without a change, in a sentence; empty: there is no reference.
  std::string sessions{};
};

}  // namespace dyngen::runtime
