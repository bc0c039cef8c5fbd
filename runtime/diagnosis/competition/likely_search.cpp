// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/likely_search.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/diagnosis/competition/heldout.h"
#include "runtime/diagnosis/scans/in_parallel.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kFamilies = 3;  // of a joint whose likelihoods are compared

bool meet(const std::vector<int>& a, const std::vector<int>& b) {
  return std::any_of(a.begin(), a.end(),
                     [&](int joint) { return std::find(b.begin(), b.end(), joint) != b.end(); });
}

}  // namespace

bool LikelySearch::next(const ModelSide& side, const ModelSide& plain,
                        const std::function<bool(const LikelyEffect&)>& take) {
  const LikelihoodRatio ratio(data_, residuals_of(data_, result_.fit.point));
  for (auto& [place, likely] : likely_) likely.fresh = false;
  std::vector<std::pair<std::size_t, const ModelSide*>> asked;
  std::set<std::size_t> places;
  const auto ask = [&](std::size_t place, const ModelSide& of) {
    if (!likely_.contains(place) && places.insert(place).second) asked.emplace_back(place, &of);
  };
  for (int joint = 0; joint < data_.joints(); ++joint) {
    for (const std::size_t place : strongest_of(side.screening, joint)) {
      ask(place, side);
    }
    for (const std::size_t place : strongest_of(plain.screening, joint)) {
      if (hypotheses_[place].windowed) continue;  // what is slow has a window that fits it
      ask(place, plain);
      break;
    }
  }
  std::vector<LikelyEffect> answers(asked.size());
  in_parallel(asked.size(), screened_.readers().size(), [&](std::size_t i, std::size_t thread) {
    answers[i] =
        compared(asked[i].first, ratio, *asked[i].second, screened_.readers()[thread].whole);
  });
  for (std::size_t i = 0; i < asked.size(); ++i) likely_[asked[i].first] = std::move(answers[i]);
  // what an earlier round said of other joints orders them; the best is asked again
  for (;;) {
    const auto best =
        std::max_element(likely_.begin(), likely_.end(),
                         [](const auto& a, const auto& b) { return a.second.net < b.second.net; });
    if (best == likely_.end() || best->second.net <= 0) return false;
    if (!best->second.fresh) {
      best->second = compared(best->first, ratio, side, screened_.readers().front().whole);
      continue;
    }
    const LikelyEffect likely = best->second;
    likely_.erase(best);
    if (!take(likely)) continue;
    const std::vector<int> joints = joints_of_hypothesis(likely.named.hypothesis);
    std::erase_if(likely_, [&](const auto& entry) {
      return meet(joints_of_hypothesis(entry.first), joints);
    });
    return true;
  }
}

LikelyEffect LikelySearch::compared(std::size_t place, const LikelihoodRatio& ratio,
                                    const ModelSide& side, EffectSignals& signals) const {
  LikelyEffect likely{side.screening.named[place], {}};
  NamedResult& named = likely.named;
  const Hypothesis& hypothesis = hypotheses_[place];
  named.best = refined(data_, signals, side.system, hypothesis, named.best,
                       scales_.of(result_.fit.point.beta, hypothesis.effect));
  try {
    likely.fit = with_(named.best.effect);
  } catch (const std::invalid_argument&) {
    return likely;  // no finite torque at the shapes that were tried
  }
  const double squares = ratio.of(residuals_of(data_, likely.fit.point));
  named.surprise = surprise_of(squares, degrees_of_refined(named, hypothesis));
  likely.net = squares - price_of(hypothesis, named.best, result_.noise);
  return likely;
}

std::vector<int> LikelySearch::joints_of_hypothesis(std::size_t place) const {
  return joints_of(hypotheses_[place].effect, data_.joints());
}

/// Admissible effects on a joint with the largest score, a few, one of each family.
std::vector<std::size_t> LikelySearch::strongest_of(const Screening& screening, int joint) const {
  std::vector<std::size_t> places;
  for (const NamedResult& named : screening.named) {
    if (!named.seen || !named.best.admissible || is_winner(result_, named.hypothesis)) continue;
    if (meet(joints_of_hypothesis(named.hypothesis), {joint})) places.push_back(named.hypothesis);
  }
  const auto net = [&](std::size_t place) {
    return net_of(hypotheses_[place], screening.named[place].best, result_.noise);
  };
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t a, std::size_t b) { return net(a) > net(b); });
  std::set<std::string> families;
  std::vector<std::size_t> few;
  for (const std::size_t place : places) {
    if (few.size() == kFamilies) break;
    if (families.insert(hypotheses_[place].effect.law.family).second) few.push_back(place);
  }
  return few;
}

}  // namespace dyngen::runtime
