// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
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

/// Which pairs are worth a fit, where neither effect is found while the other is left out.
class PairSearch {
 public:
  /// All must outlive it. @param false_alarm  as in CompetitionOptions
  /// @param result  what was found so far
  PairSearch(const CompetitionData& data, const Sought& sought, const StictionImpulses& stiction,
             const EffectConditions& conditions, double false_alarm,
             const CompetitionResult& result)
      : data_(data),
        sought_(sought),
        stiction_(stiction),
        conditions_(conditions),
        false_alarm_(false_alarm),
        result_(result) {}

  /// The first few of strongest_pairs(); none while a joint begins to rest.
  [[nodiscard]] std::vector<EffectPair> strongest(const EvidenceSystem& system,
                                                  const Screening& screening) const;
  /// Whether both together are more than noise, pay for their parameters, and are neither outdone
  /// by what has no name nor explained by stops.
  [[nodiscard]] bool promising(const EffectPair& pair, const EvidenceSystem& system,
                               const Screening& screening) const;

 private:
  const CompetitionData& data_;
  const Sought& sought_;
  const StictionImpulses& stiction_;
  const EffectConditions& conditions_;
  double false_alarm_;
  const CompetitionResult& result_;
};

}  // namespace dyngen::runtime
