// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"

namespace dyngen::runtime {

/// Equations of the same recordings up to a part of the band, where motion stands above the noise
/// of the positions. What acts in the recordings acts there as well: an effect whose size is
/// another there has only explained what the positions do not show. The test of Hausman (1978).
class HalfBandTest {
 public:
  /// @param data  must outlive it
  explicit HalfBandTest(const EffectRecordings& data);

  /// Whether an effect's size is another here: surely, and by half of it.
  /// @param point   a fit of the model with the winners and, as its last, the effect
  [[nodiscard]] bool contradicts(const std::vector<Hypothesis>& hypotheses,
                                 const CompetitionResult& result, const Hypothesis& hypothesis,
                                 const EffectPoint& point, EvidenceSystem::Options options);
  /// Whether structure of this size is not here: surely, and by half of it.
  [[nodiscard]] bool contradicts(const std::vector<Hypothesis>& hypotheses,
                                 const CompetitionResult& result, const Nameless& nameless,
                                 EvidenceSystem::Options options);

 private:
  [[nodiscard]] EvidenceSystem system(const std::vector<Hypothesis>& hypotheses,
                                      const CompetitionResult& result, const EffectPoint& point,
                                      EvidenceSystem::Options options);

  const EffectRecordings& data_;
  EffectSignals signals_;
  std::vector<double> repeats_;
};

}  // namespace dyngen::runtime
