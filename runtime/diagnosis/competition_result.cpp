// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition_result.h"

#include <algorithm>
#include <cmath>

#include "runtime/diagnosis/heldout.h"

namespace dyngen::runtime {

double price_of(const Hypothesis& hypothesis, int degrees, const TorqueNoiseModel& noise) {
  const double parameters = degrees + static_cast<double>(hypothesis.shapes.size());
  return parameters * std::log(std::max(noise.worth.sum(), 2.0));
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

void add_nameless(const EffectRecordings& data, EffectSignals& signals,
                  const CompetitionResult& result, EvidenceSystem& system) {
  for (const int joint : result.resting) {
    system.leave_out(system.whitened(generic_columns(data, signals, impulses_at_reversals(joint))));
  }
  for (const Nameless& nameless : result.nameless) {
    system.add(system.whitened(generic_columns(data, signals, nameless.structure)));
  }
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
  add_nameless(data, signals, result, system);
  return system;
}

}  // namespace dyngen::runtime
