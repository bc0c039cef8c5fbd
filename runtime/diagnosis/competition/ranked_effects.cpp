// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/ranked_effects.h"

#include <algorithm>

#include "runtime/diagnosis/competition/within_rounding.h"
#include "runtime/diagnosis/scans/in_parallel.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kRefined = 12;  // candidates whose shapes are refined in a round
constexpr std::size_t kAttempts = 4;  // effects that are fitted in a round before it gives up

}  // namespace

RankedEffects::RankedEffects(const RoundJudges& judges, const EvidenceSystem& system,
                             Screening& screening, ScreeningData& readers,
                             const std::function<void(double)>& progress)
    : judges_(judges), system_(system), screening_(screening) {
  for (const NamedResult& named : screening_.named) {
    if (named.seen && named.best.admissible && !is_winner(judges_.result, named.hypothesis)) {
      order_.push_back(named.hypothesis);
    }
  }
  sort();
  if (order_.size() > kRefined) order_.resize(kRefined);
  refine(readers, progress);
  for (const std::size_t place : order_) {
    const NamedResult& named = screening_.named[place];
    if (within_rounding(judges_.data.evidence, judges_.sought.hypotheses[place],
                        named.best.effect)) {
      stopped_.insert(place);
    }
  }
  sort();
}

void RankedEffects::sort() {
  const auto standing = [&](std::size_t place) {
    return judges_.sought.standing(screening_.named[place], judges_.result.noise);
  };
  std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
    return comes_before(standing(a), standing(b));
  });
}

/// Shapes between those of the grid.
void RankedEffects::refine(ScreeningData& readers, const std::function<void(double)>& progress) {
  const auto refine_one = [&](std::size_t piece, std::size_t thread) {
    NamedResult& named = screening_.named[order_[piece]];
    if (screening_.family_wise(named.surprise) > 0.5) return;
    const Hypothesis& hypothesis = judges_.sought.hypotheses[named.hypothesis];
    named.best = refined(
        judges_.data.evidence, readers.readers()[thread].whole, system_, hypothesis, named.best,
        judges_.sought.scales.of(judges_.result.fit.point.beta, hypothesis.effect));
    named.surprise = surprise_of_refined(named, hypothesis);
  };
  in_parallel(order_.size(), readers.readers().size(), refine_one, progress);
}

/// What may be a remnant of what was found has to be beyond doubt.
bool RankedEffects::is_remnant(const NamedResult& named) const {
  const std::vector<Hypothesis>& hypotheses = judges_.sought.hypotheses;
  if (is_part_of_found_event(judges_.result, hypotheses, named.hypothesis, named.best.effect)) {
    return true;
  }
  return may_be_remnant(judges_.result, hypotheses, named.hypothesis) &&
         !judges_.nameless.sure(screening_, named.surprise);
}

std::optional<RankedEffect> RankedEffects::next(bool outdone) {
  using Beside = EffectConditions::Beside;
  if (outdone != outdone_) {
    outdone_ = outdone;
    asked_ = 0;
    before_ = attempted_.size();
  }
  while (asked_ < order_.size() && attempted_.size() - before_ < kAttempts) {
    const std::size_t place = order_[asked_++];
    const NamedResult& named = screening_.named[place];
    if (stopped_.contains(place) || attempted_.contains(place)) continue;
    if (screening_.family_wise(named.surprise) > judges_.false_alarm) continue;
    if (judges_.sought.net(named, judges_.result.noise) <= 0) {
      if (!costly_) costly_ = place;
      continue;
    }
    const std::vector<int> joints = judges_.sought.joints(place);
    if (named.best.score.delta_chi2 < judges_.stiction.unseen_on(joints)) continue;
    const Beside beside = judges_.conditions.beside(named, system_, screening_);
    if ((beside == Beside::kOutdone) != outdone) continue;
    if (outdone && !judges_.nameless.sure(screening_, named.surprise)) continue;
    const StictionImpulses::Part stiction =
        judges_.stiction.part_in(system_, screening_, judges_.sought.hypotheses[place], named);
    if (stiction == StictionImpulses::Part::kAll ||
        judges_.conditions.is_no_event(system_, named) || is_remnant(named)) {
      stopped_.insert(place);
      continue;
    }
    stopped_.insert(attempted_.begin(), attempted_.end());
    return RankedEffect{place, stiction, beside};
  }
  return std::nullopt;
}

}  // namespace dyngen::runtime
