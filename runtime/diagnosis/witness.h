// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "runtime/diagnosis/competition_result.h"

namespace dyngen::runtime {

/// Equations of the same recordings that are made another way: up to a part of the band, where
/// motion stands above the noise of the positions; or at the motion of the other periods, whose
/// noise is not theirs (instrumental variables; Janot, Vandanjon and Gautier 2014). What acts in
/// the recordings acts there as well: an effect whose size is another there has only explained what
/// the positions do not show, or their noise, which in a loop is also in the torque. The test of
/// Hausman (1978).
class Witness {
 public:
  enum class Kind {
    kSlow,      ///< up to a part of the band
    kRepeated,  ///< at the motion of the other periods
  };
  /// @param data  must outlive it
  Witness(const EffectRecordings& data, Kind kind);

  /// Whether an effect's size is another here: surely, and by half of it; or whether of what it
  /// explains hardly anything is left at the motion of the other periods.
  /// @param point   a fit of the model with the winners and, as its last, the effect
  /// @param squares  that it explains
  [[nodiscard]] bool contradicts(const std::vector<Hypothesis>& hypotheses,
                                 const CompetitionResult& result, const Hypothesis& hypothesis,
                                 const EffectPoint& point, double squares,
                                 EvidenceSystem::Options options);
  /// Whether structure of this size is not here: surely, and by half of it.
  [[nodiscard]] bool contradicts(const std::vector<Hypothesis>& hypotheses,
                                 const CompetitionResult& result, const Nameless& nameless,
                                 EvidenceSystem::Options options);

 private:
  [[nodiscard]] EvidenceSystem system(const std::vector<Hypothesis>& hypotheses,
                                      const CompetitionResult& result, const EffectPoint& point,
                                      EvidenceSystem::Options options);

  [[nodiscard]] bool misses(double seen, double squares) const;

  const EffectRecordings& data_;
  Kind kind_;
  EffectSignals signals_;
  std::vector<double> repeats_;
};

/// All that are asked.
using Witnesses = std::vector<std::unique_ptr<Witness>>;

}  // namespace dyngen::runtime
