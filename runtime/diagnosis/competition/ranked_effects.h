// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "runtime/diagnosis/competition/competition_data.h"
#include "runtime/diagnosis/competition/effect_conditions.h"
#include "runtime/diagnosis/competition/nameless_search.h"
#include "runtime/diagnosis/competition/sought.h"
#include "runtime/diagnosis/competition/stiction_impulses.h"

namespace dyngen::runtime {

/// An effect that may win a round.
struct RankedEffect {
  std::size_t hypothesis = 0;  ///< its place
  StictionImpulses::Part stiction = StictionImpulses::Part::kNone;
  EffectConditions::Beside beside = EffectConditions::Beside::kNothing;
};

/// What judges the effects of a round. All of it outlives the round.
struct RoundJudges {
  const CompetitionData& data;
  const Sought& sought;
  const StictionImpulses& stiction;
  const EffectConditions& conditions;
  const NamelessSearch& nameless;
  const CompetitionResult& result;  ///< what was found so far
  double false_alarm = 0;           ///< of DiagnosisOptions
};

/// The effects that may win a round, the best first. Each is handed out once.
class RankedEffects {
 public:
  /// Orders them, and refines the shapes of the first.
  /// @param system     the model with what was found
  /// @param screening  beside it; the estimates of refined effects are put there. Both outlive
  /// this.
  /// @param readers    of the evidence, one for each thread
  /// @param progress   called with the part that is done
  RankedEffects(const RoundJudges& judges, const EvidenceSystem& system, Screening& screening,
                ScreeningData& readers, const std::function<void(double)>& progress);

  /// The next one, or none. @param outdone  those beside which what has no name explains more,
  /// which have to be beyond doubt; else those beside which nothing does
  [[nodiscard]] std::optional<RankedEffect> next(bool outdone);
  /// That one was fitted, and turned down if another one is asked for.
  void tried(std::size_t hypothesis) { attempted_.insert(hypothesis); }

  /// Places of the first, the best first.
  [[nodiscard]] const std::vector<std::size_t>& order() const { return order_; }
  [[nodiscard]] const std::set<std::size_t>& attempted() const { return attempted_; }
  /// Those that cannot win any more: explained by stops or by rounding, or turned down.
  [[nodiscard]] const std::set<std::size_t>& stopped() const { return stopped_; }
  /// The first that is more than noise, but not worth its parameters.
  [[nodiscard]] std::optional<std::size_t> costly() const { return costly_; }

 private:
  void sort();
  void refine(ScreeningData& readers, const std::function<void(double)>& progress);
  [[nodiscard]] bool is_remnant(const NamedResult& named) const;

  const RoundJudges& judges_;
  const EvidenceSystem& system_;
  Screening& screening_;
  std::vector<std::size_t> order_;
  std::set<std::size_t> attempted_;  // fitted
  std::set<std::size_t> stopped_;
  std::optional<std::size_t> costly_;
  std::size_t asked_ = 0;   // of the order
  bool outdone_ = false;    // of these
  std::size_t before_ = 0;  // attempts before them
};

}  // namespace dyngen::runtime
