// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "runtime/diagnosis/equation_sets/stiction_joint.h"
#include "runtime/diagnosis/scans/screening.h"
#include "runtime/effects/effect_fit.h"

namespace dyngen::runtime {

/// An effect that won a round.
struct Winner {
  std::size_t hypothesis = 0;  ///< its place
  TrialScore trial;            ///< beside the model of its round
  double surprise = 0;         ///< in its round
  /// It makes the impulses at the stops of its joints (StictionImpulses::Part::kBecause): judged
  /// beside what is left of those it would not be seen.
  bool at_stiction = false;
  /// In its round something without a name explained more on one of its joints: where structure
  /// without a name stays there, it may be a part of that.
  bool outdone = false;
  std::vector<NamedResult> others;     ///< its round's results, its own among them
  std::vector<GenericResult> generic;  ///< and those of structures without a name
};

/// Structure that no effect explains.
struct Nameless {
  GenericStructure structure;
  Score score;
  double surprise = 0;
  double rms = 0;  ///< N m or N, of what the columns explain of the joint's equations
  /// An effect that explains it, for more parameters than the data pay for; or empty.
  std::string costly;
  /// An effect whose columns these are, but which a bound or a falsifier rules out as their name.
  std::optional<EffectInstance> ruled_out;
  std::string objection;            ///< "k >= 0 does not hold"
  std::vector<std::size_t> beside;  ///< hypotheses of the winners that were found before it

  /// Variables that it goes with, joints from 1.
  [[nodiscard]] std::vector<std::string> names() const;
};

/// Columns of nameless structure, behind the parallel filter.
JointColumns nameless_columns(const EffectRecordings& data, EffectSignals& signals,
                              const Nameless& nameless);

/// How a competition ended.
struct CompetitionResult {
  std::vector<Winner> winners;
  std::vector<Nameless> nameless;
  std::vector<StictionJoint> sticking;
  EffectFit base;          ///< of the model alone
  EffectFit fit;           ///< of the model with the winners
  TorqueNoiseModel noise;  ///< of the last round
  Screening first, last;   ///< of the model alone, and with everything that was found
  /// Searches that were left out, or ended, where the work was bounded: "pairs of effects".
  std::vector<std::string> cut_off;
};

/// Settings of fits that are compared with one another: a chi-square of 1e5 is exact to 0.1.
EffectFitOptions comparison_fit();

/// Whether a hypothesis has won already.
bool is_winner(const CompetitionResult& result, std::size_t hypothesis);

/// Whether a joint has structure without a name already.
bool has_nameless(const CompetitionResult& result, int joint);

/// Whether a hypothesis may be a remnant of what was found. Structure without a name is a sketch,
/// and so is the course of what changes with time: one event among thousands that were tried may
/// explain what they leave.
bool may_be_remnant(const CompetitionResult& result, const std::vector<Hypothesis>& hypotheses,
                    std::size_t hypothesis);

/// Whether an event overlaps one of its family that was found, in the same recording: the form of
/// an event's course is not known, and what it leaves is no second event.
/// @param event  an estimate of a hypothesis
bool is_part_of_found_event(const CompetitionResult& result,
                            const std::vector<Hypothesis>& hypotheses, std::size_t hypothesis,
                            const EffectInstance& event);

/// The model with what is given beside it: regressor, and effects at their estimates with the
/// columns of all their unknown parameters.
EvidenceSystem system_at(const EffectRecordings& data, EffectSignals& signals,
                         const EffectPoint& point, const std::vector<Hypothesis>& beside,
                         const TorqueNoiseModel& noise, const EvidenceSystem::Options& options);

/// A point without one of its effects.
EffectPoint without(EffectPoint point, std::size_t place);

/// Whether structure is the form of an effect that a condition rules out, found beside a winner of
/// the same joint: it is what the winner leaves. Beside all of that form the winner would be
/// nothing.
bool is_left_by(const Nameless& nameless, std::size_t hypothesis, const std::vector<int>& joints);

/// The model with all that was found. @param point  with the effects of all winners
EvidenceSystem system_beside(const EffectRecordings& data, EffectSignals& signals,
                             const std::vector<Hypothesis>& hypotheses,
                             const CompetitionResult& result, const EffectPoint& point,
                             const TorqueNoiseModel& noise, const EvidenceSystem::Options& options);

/// The model with all that was found but one winner, and forms that are left by it.
EvidenceSystem system_without(const EffectRecordings& data, EffectSignals& signals,
                              const std::vector<Hypothesis>& hypotheses,
                              const CompetitionResult& result, std::size_t winner,
                              const EvidenceSystem::Options& options);

/// What a score costs in the currency of squares: its parameters, at the information that the
/// equations hold (Schwarz 1978 with the number of independent samples): all of them on its shapes,
/// and on its sizes those in which it acts. Values beyond their usual ranges cost their prior odds.
double price_of(const Hypothesis& hypothesis, const TrialScore& trial,
                const TorqueNoiseModel& noise);

/// Squares less their price. Of the linear parameters those are paid that are worth it, and for
/// which of them they are (Chen and Chen 2008): a load needs no tensor of inertia to be seen.
double net_of(const Hypothesis& hypothesis, const TrialScore& trial, const TorqueNoiseModel& noise);

/// The same of structure without a name: its columns, and the frequencies that were looked for.
double net_of(const GenericStructure& structure, const Score& score, const TorqueNoiseModel& noise);

}  // namespace dyngen::runtime
