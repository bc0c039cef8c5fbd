// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/competition_result.h"

namespace dyngen::runtime {

/// The recordings up to half of the band that a diagnosis uses, where motion stands above the noise
/// of the positions. What acts there acts on them as well: a name whose size they contradict has
/// only explained what the positions do not show (accelerations in a loop that friction excites).
/// The test of Hausman (1978), in which an estimate from a part of the data is compared with one
/// from all of it.
class SlowEquations {
 public:
  /// @param data  must outlive it
  explicit SlowEquations(const EffectRecordings& data);
  SlowEquations(const SlowEquations&) = delete;
  SlowEquations& operator=(const SlowEquations&) = delete;

  /// Whether an effect's size is another here: surely, and by half of it.
  /// @param point   a fit of the model with the winners and, as its last, the effect
  [[nodiscard]] bool contradict(const std::vector<Hypothesis>& hypotheses,
                                const CompetitionResult& result, const Hypothesis& hypothesis,
                                const EffectPoint& point, EvidenceSystem::Options options);

 private:
  const EffectRecordings& data_;
  EffectSignals signals_;
  std::vector<double> repeats_;
};

}  // namespace dyngen::runtime
