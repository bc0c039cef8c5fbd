// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/competition_result.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/scans/generic_columns.h"

namespace dyngen::runtime {

std::vector<std::string> Nameless::names() const {
  if (!ruled_out) return structure.names();
  constexpr std::array<std::pair<const char*, const char*>, 5> kShown = {
      {{"q", "q"}, {"qd", "qd"}, {"qdd", "qdd"}, {"tau_load", "tau_load"}, {"sign_qd", "qd"}}};
  std::vector<std::string> names;
  for (const std::string& variable : ruled_out->law.variables) {
    for (const auto& [read, shown] : kShown) {
      if (variable != read) continue;
      const std::string name = fmt::format("{}{}", shown, structure.joint + 1);
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    if (variable == "t") names.emplace_back("t");
  }
  if (names.empty()) names.push_back(fmt::format("q{}", structure.joint + 1));
  return names;
}

JointColumns nameless_columns(const EffectRecordings& data, EffectSignals& signals,
                              const Nameless& nameless) {
  if (!nameless.ruled_out) return generic_columns(data, signals, nameless.structure);
  std::vector<int> wanted;
  const EffectLaw& law = nameless.ruled_out->law;
  for (int p = 0; p < law.size(); ++p) {
    if (law.parameters[static_cast<std::size_t>(p)].role == EffectRole::kLinear) {
      wanted.push_back(1 + p);
    }
  }
  if (wanted.empty()) wanted.push_back(0);
  return effect_columns(data, signals, *nameless.ruled_out, wanted);
}

namespace {

/// @param part  of the equations
double price_of_one(const TorqueNoiseModel& noise, double part = 1) {
  return std::log(std::max(noise.worth.sum() * part, 2.0));
}

/// Of some sizes.
double price_of(const Hypothesis& hypothesis, double sizes, double part,
                const TorqueNoiseModel& noise) {
  return sizes * price_of_one(noise, part) +
         static_cast<double>(hypothesis.shapes.size()) * price_of_one(noise);
}

}  // namespace

double price_of(const Hypothesis& hypothesis, const TrialScore& trial,
                const TorqueNoiseModel& noise) {
  return price_of(hypothesis, trial.score.degrees, trial.part, noise) + trial.unusual;
}

double net_of(const GenericStructure& structure, const Score& score,
              const TorqueNoiseModel& noise) {
  const int frequencies = structure.form == GenericStructure::Form::kLine   ? 1
                          : structure.form == GenericStructure::Form::kWave ? 2
                                                                            : 0;
  return score.delta_chi2 - (score.degrees + frequencies) * price_of_one(noise);
}

double net_of(const Hypothesis& hypothesis, const TrialScore& trial,
              const TorqueNoiseModel& noise) {
  double best = trial.score.delta_chi2 - price_of(hypothesis, trial, noise);
  double choices = 1;  // ways to take m of all linear parameters
  const auto all = static_cast<double>(trial.few.size());
  for (std::size_t m = 1; m < trial.few.size(); ++m) {
    const auto taken = static_cast<double>(m);
    choices *= (all - taken + 1) / taken;
    const double price =
        price_of(hypothesis, taken, trial.part, noise) + 2 * std::log(choices) + trial.unusual;
    best = std::max(best, trial.few[m - 1] - price);
  }
  return best;
}

EffectFitOptions comparison_fit() {
  EffectFitOptions settings;
  settings.most_rounds = 2;
  settings.most_steps = 15;
  settings.tolerance = 1e-6;
  return settings;
}

bool is_winner(const CompetitionResult& result, std::size_t hypothesis) {
  return std::any_of(result.winners.begin(), result.winners.end(),
                     [&](const Winner& winner) { return winner.hypothesis == hypothesis; });
}

bool has_nameless(const CompetitionResult& result, int joint) {
  return std::any_of(result.nameless.begin(), result.nameless.end(),
                     [&](const Nameless& nameless) { return nameless.structure.joint == joint; });
}

bool may_be_remnant(const CompetitionResult& result, const std::vector<Hypothesis>& hypotheses,
                    std::size_t hypothesis) {
  if (!hypotheses[hypothesis].windowed) return false;
  const auto changes_with_time = [&](const Winner& winner) {
    const Hypothesis& other = hypotheses[winner.hypothesis];
    return !other.windowed && other.effect.law.reads("t");
  };
  return !result.nameless.empty() ||
         std::any_of(result.winners.begin(), result.winners.end(), changes_with_time);
}

namespace {

struct Times {
  double begin = 0, end = 0;
};

/// Of an event; what only begins has no end.
Times times_of(const Hypothesis& hypothesis, const EffectInstance& event) {
  const double begin = event.parameters[hypothesis.shapes.front()];
  if (hypothesis.shapes.size() < 2) return {begin, std::numeric_limits<double>::infinity()};
  return {begin, event.parameters[hypothesis.shapes[1]]};
}

}  // namespace

bool is_part_of_found_event(const CompetitionResult& result,
                            const std::vector<Hypothesis>& hypotheses, std::size_t hypothesis,
                            const EffectInstance& event) {
  const Hypothesis& own = hypotheses[hypothesis];
  if (!own.windowed) return false;
  const Times times = times_of(own, event);
  for (std::size_t i = 0; i < result.winners.size() && i < result.fit.point.effects.size(); ++i) {
    const Hypothesis& other = hypotheses[result.winners[i].hypothesis];
    const EffectInstance& found = result.fit.point.effects[i];
    if (!other.windowed || other.effect.law.family != own.effect.law.family) continue;
    const bool together =
        event.recording < 0 || found.recording < 0 || event.recording == found.recording;
    const Times known = times_of(other, found);
    if (together && times.begin < known.end && known.begin < times.end) return true;
  }
  return false;
}

EvidenceSystem system_at(const EffectRecordings& data, EffectSignals& signals,
                         const EffectPoint& point, const std::vector<Hypothesis>& beside,
                         const TorqueNoiseModel& noise, const EvidenceSystem::Options& options) {
  signals.set_beta(point.beta);
  signals.set_tangent_beta(point.beta);
  EvidenceSystem system(data, residuals_of(data, point), noise, options);
  for (std::size_t i = 0; i < beside.size(); ++i) {
    std::vector<int> wanted;
    for (const int p : beside[i].linear) wanted.push_back(1 + p);
    for (const int p : beside[i].shapes) {
      if (!beside[i].windowed) wanted.push_back(1 + p);
    }
    system.add(system.whitened(effect_columns(data, signals, point.effects[i], wanted)));
  }
  return system;
}

EffectPoint without(EffectPoint point, std::size_t place) {
  const auto at = static_cast<std::ptrdiff_t>(place);
  point.effects.erase(point.effects.begin() + at);
  for (auto& run : point.initial) run.erase(run.begin() + at);
  return point;
}

bool is_left_by(const Nameless& nameless, std::size_t hypothesis, const std::vector<int>& joints) {
  const auto has = [](const auto& all, const auto& own) {
    return std::find(all.begin(), all.end(), own) != all.end();
  };
  return nameless.ruled_out && has(nameless.beside, hypothesis) &&
         has(joints, nameless.structure.joint);
}

namespace {

/// What was found and has no name becomes part of a model: structures, and impulses of joints that
/// rest.
/// @param sticks, counts  of which joints, and which structures
template <class Sticks, class Counts>
void add_nameless(const EffectRecordings& data, EffectSignals& signals,
                  const CompetitionResult& result, EvidenceSystem& system, const Sticks& sticks,
                  const Counts& counts) {
  for (const StictionJoint& sticking : result.sticking) {
    if (!sticks(sticking.joint)) continue;
    system.leave_out(
        system.whitened(generic_columns(data, signals, impulses_at_reversals(sticking.joint))));
  }
  for (const Nameless& nameless : result.nameless) {
    if (!counts(nameless)) continue;
    system.add(system.whitened(nameless_columns(data, signals, nameless)));
  }
}

}  // namespace

EvidenceSystem system_beside(const EffectRecordings& data, EffectSignals& signals,
                             const std::vector<Hypothesis>& hypotheses,
                             const CompetitionResult& result, const EffectPoint& point,
                             const TorqueNoiseModel& noise,
                             const EvidenceSystem::Options& options) {
  std::vector<Hypothesis> beside;
  for (const Winner& winner : result.winners) beside.push_back(hypotheses[winner.hypothesis]);
  EvidenceSystem system = system_at(data, signals, point, beside, noise, options);
  add_nameless(
      data, signals, result, system, [](int) { return true; },
      [](const Nameless&) { return true; });
  return system;
}

EvidenceSystem system_without(const EffectRecordings& data, EffectSignals& signals,
                              const std::vector<Hypothesis>& hypotheses,
                              const CompetitionResult& result, std::size_t winner,
                              const EvidenceSystem::Options& options) {
  std::vector<Hypothesis> beside;
  for (std::size_t k = 0; k < result.winners.size(); ++k) {
    if (k != winner) beside.push_back(hypotheses[result.winners[k].hypothesis]);
  }
  EvidenceSystem system =
      system_at(data, signals, without(result.fit.point, winner), beside, result.noise, options);
  const Winner& own = result.winners[winner];
  const std::vector<int> joints = joints_of(hypotheses[own.hypothesis].effect, data.joints());
  add_nameless(
      data, signals, result, system,
      [&](int joint) {
        return !own.at_stiction || std::find(joints.begin(), joints.end(), joint) == joints.end();
      },
      [&](const Nameless& nameless) { return !is_left_by(nameless, own.hypothesis, joints); });
  return system;
}

}  // namespace dyngen::runtime
