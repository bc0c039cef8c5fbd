// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/effect_conditions.h"
#include "runtime/diagnosis/competition/stiction_impulses.h"

namespace dyngen::runtime {

/// Two effects beside one model, at the shapes of a screening. What each acts on may be taken up by
/// the other for a part, so that neither explains enough while the other is left out.
struct EffectPair {
  std::size_t stronger = 0, weaker = 0;  ///< places of hypotheses, by the squares of each alone
  double net = 0;                        ///< squares of both less the price of both
  /// -ln p of the one that is less beside the other, less what choosing it cost; at least 0.
  double surprise = 0;
};

/// Pairs of effects that each act on several joints: of those only, since two effects of one joint
/// are as often one shape that the catalogue has not. Of the strongest two dozen alone, whatever
/// bounds and falsifiers say of them alone. Events are none.
/// @param result  whose winners are none of them, and whose noise has the price
/// @return the strongest first
std::vector<EffectPair> strongest_pairs(const EffectRecordings& data, EffectSignals& signals,
                                        const EvidenceSystem& system,
                                        const std::vector<Hypothesis>& hypotheses,
                                        const Screening& screening,
                                        const CompetitionResult& result);

/// Two effects of which neither is found while the other is left out: each has to be found beside
/// the other.
class PairSearch {
 public:
  /// How a competition fits, and finds.
  struct Steps {
    std::function<EffectFit(const std::vector<EffectInstance>&)> fit;  ///< the model with effects
    /// One winner more, by a round of its own. @param wanted  how many there are to be
    std::function<bool(std::size_t wanted)> next_beside;
  };

  /// All must outlive it. @param false_alarm  as in CompetitionOptions
  PairSearch(const EffectRecordings& data, EffectSignals& signals,
             const std::vector<Hypothesis>& hypotheses, const StictionImpulses& stiction,
             const EffectConditions& conditions, double false_alarm, CompetitionResult& result,
             Steps steps)
      : data_(data),
        signals_(signals),
        hypotheses_(hypotheses),
        stiction_(stiction),
        conditions_(conditions),
        false_alarm_(false_alarm),
        result_(result),
        steps_(std::move(steps)) {}

  /// Tries the strongest pairs. @return whether two winners more are in the result
  bool next(const EvidenceSystem& system, const Screening& screening);

 private:
  [[nodiscard]] bool promising(const EffectPair& pair, const EvidenceSystem& system,
                               const Screening& screening) const;
  bool find(const EffectPair& pair, const Screening& screening);

  const EffectRecordings& data_;
  EffectSignals& signals_;
  const std::vector<Hypothesis>& hypotheses_;
  const StictionImpulses& stiction_;
  const EffectConditions& conditions_;
  double false_alarm_;
  CompetitionResult& result_;
  Steps steps_;
};

}  // namespace dyngen::runtime
