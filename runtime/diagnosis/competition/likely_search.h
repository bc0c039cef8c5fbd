// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "runtime/diagnosis/competition/beside_white_noise.h"
#include "runtime/diagnosis/competition/competition_data.h"
#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/likelihood.h"
#include "runtime/diagnosis/competition/sought.h"

namespace dyngen::runtime {

/// An effect that was fitted with all that was found before.
struct LikelyEffect {
  NamedResult named;  ///< surprise: of the likelihoods' ratio
  EffectFit fit;
  double net = 0;     ///< the ratio less its price; 0: there is no such fit
  bool fresh = true;  ///< fitted in this round
};

/// Where no motion repeats, noise is known from what the model leaves alone, and an effect that is
/// most of that has made it seem slow and large. So the strongest effects of each joint are fitted,
/// and compared by their likelihoods, each with a noise of its own.
class LikelySearch {
 public:
  struct Calls {
    /// Fits the model and what was found with one effect more; from several threads.
    std::function<EffectFit(const EffectInstance&)> fit_with;
    /// Whether the work that may be done is done: then effects that were not fitted are left out.
    std::function<bool()> exhausted;
  };
  /// All must outlive it. @param screened  of the same evidence
  /// @param result  what was found so far
  LikelySearch(const CompetitionData& data, const Sought& sought, ScreeningData& screened,
               const CompetitionResult& result, Calls calls)
      : data_(data),
        sought_(sought),
        screened_(screened),
        result_(result),
        calls_(std::move(calls)) {}

  /// Offers the likeliest of all by the tie rule (comes_before()), then the next, until one is
  /// taken.
  /// @param plain  beside white noise: noise that has slow structure in it hides that structure, so
  ///               each joint's best of it is compared too
  /// @param take   keeps what it is offered, or refuses. @return whether one was taken
  bool next(const ModelSide& side, const ModelSide& plain,
            const std::function<bool(const LikelyEffect&)>& take);

 private:
  LikelyEffect compared(std::size_t place, const LikelihoodRatio& ratio, const ModelSide& side,
                        EffectSignals& signals) const;
  [[nodiscard]] Standing standing(const LikelyEffect& likely) const;
  [[nodiscard]] std::vector<std::size_t> strongest_of(const Screening& screening, int joint) const;

  const CompetitionData& data_;
  const Sought& sought_;
  ScreeningData& screened_;
  const CompetitionResult& result_;
  Calls calls_;
  std::map<std::size_t, LikelyEffect> likely_;  // by hypothesis; of this round or an earlier one
};

}  // namespace dyngen::runtime
