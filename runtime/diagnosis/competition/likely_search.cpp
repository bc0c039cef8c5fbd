// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/likely_search.h"

#include <algorithm>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/scans/in_parallel.h"
#include "runtime/estimation/decompositions.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kFamilies = 3;    // of a joint whose likelihoods are compared
constexpr std::size_t kFitsAtOnce = 4;  // fits between two looks at the work that is done

bool meet(const std::vector<int>& a, const std::vector<int>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](int joint) { return std::find(b.begin(), b.end(), joint) != b.end(); });
}

}  // namespace

bool LikelySearch::next(const ModelSide& side, const ModelSide& plain,
                        const std::function<bool(const LikelyEffect&)>& take) {
  const LikelihoodRatio ratio(data_.evidence, residuals_of(data_.evidence, result_.fit.point));
  for (auto& [place, likely] : likely_) likely.fresh = false;
  std::vector<std::pair<std::size_t, const ModelSide*>> asked;
  std::set<std::size_t> places;
  const auto ask = [&](std::size_t place, const ModelSide& of) {
    if (!likely_.contains(place) && places.insert(place).second) asked.emplace_back(place, &of);
  };
  for (int joint = 0; joint < data_.evidence.joints(); ++joint) {
    for (const std::size_t place : strongest_of(side.screening, joint)) {
      ask(place, side);
    }
    for (const std::size_t place : strongest_of(plain.screening, joint)) {
      if (sought_.hypotheses[place].windowed) continue;  // what is slow has a window that fits it
      ask(place, plain);
      break;
    }
  }
  std::vector<LikelyEffect> answers(asked.size());
  for (std::size_t begin = 0; begin < asked.size() && !calls_.exhausted(); begin += kFitsAtOnce) {
    const std::size_t count = std::min(kFitsAtOnce, asked.size() - begin);
    in_parallel(count, screened_.readers().size(), [&](std::size_t piece, std::size_t thread) {
      const auto& [place, of] = asked[begin + piece];
      answers[begin + piece] = compared(place, ratio, *of, screened_.readers()[thread].whole);
    });
    for (std::size_t i = begin; i < begin + count; ++i) {
      likely_[asked[i].first] = std::move(answers[i]);
    }
  }
  // what an earlier round said of other joints orders them; the best is asked again
  for (;;) {
    const auto best =
        std::min_element(likely_.begin(), likely_.end(), [&](const auto& a, const auto& b) {
          return comes_before(standing(a.second), standing(b.second));
        });
    if (best == likely_.end() || best->second.net <= 0) return false;
    if (!best->second.fresh) {
      if (calls_.exhausted()) return false;
      best->second = compared(best->first, ratio, side, screened_.readers().front().whole);
      continue;
    }
    const LikelyEffect likely = best->second;
    likely_.erase(best);
    if (!take(likely)) continue;
    const std::vector<int> joints = sought_.joints(likely.named.hypothesis);
    std::erase_if(likely_,
                  [&](const auto& entry) { return meet(sought_.joints(entry.first), joints); });
    return true;
  }
}

LikelyEffect LikelySearch::compared(std::size_t place, const LikelihoodRatio& ratio,
                                    const ModelSide& side, EffectSignals& signals) const {
  LikelyEffect likely{side.screening.named[place], {}};
  NamedResult& named = likely.named;
  const Hypothesis& hypothesis = sought_.hypotheses[place];
  named.best = refined(data_.evidence, signals, side.system, hypothesis, named.best,
                       sought_.scales.of(result_.fit.point.beta, hypothesis.effect));
  try {
    likely.fit = calls_.fit_with(named.best.effect);
  } catch (const NotFiniteError&) {
    return likely;  // there is no such fit
  }
  const double squares = ratio.of(residuals_of(data_.evidence, likely.fit.point));
  named.surprise = surprise_of(squares, degrees_of_refined(named, hypothesis));
  TrialScore fitted = named.best;  // the fit moved its shapes
  fitted.unusual = price_of_unusual(likely.fit.point.effects.back(),
                                    sought_.scales.of(likely.fit.point.beta, hypothesis.effect),
                                    side.system.priors());
  likely.net = squares - price_of(hypothesis, fitted, result_.noise);
  return likely;
}

/// What does not pay for its parameters, or has no fit, stands behind all that does.
Standing LikelySearch::standing(const LikelyEffect& likely) const {
  constexpr double kNothing = -std::numeric_limits<double>::infinity();
  return {likely.net > 0 ? likely.net : kNothing, sought_.parameters(likely.named.hypothesis)};
}

/// Admissible effects on a joint with the largest score, a few, one of each family.
std::vector<std::size_t> LikelySearch::strongest_of(const Screening& screening, int joint) const {
  std::vector<std::size_t> places;
  for (const NamedResult& named : screening.named) {
    if (!named.seen || !named.best.admissible || is_winner(result_, named.hypothesis)) continue;
    if (meet(sought_.joints(named.hypothesis), {joint})) places.push_back(named.hypothesis);
  }
  const auto net = [&](std::size_t place) {
    return net_of(sought_.hypotheses[place], screening.named[place].best, result_.noise);
  };
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t a, std::size_t b) { return net(a) > net(b); });
  std::set<std::string> families;
  std::vector<std::size_t> few;
  for (const std::size_t place : places) {
    if (few.size() == kFamilies) break;
    if (families.insert(sought_.hypotheses[place].effect.law.family).second) few.push_back(place);
  }
  return few;
}

}  // namespace dyngen::runtime
