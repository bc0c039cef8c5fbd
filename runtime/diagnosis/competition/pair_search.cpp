// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/pair_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr std::size_t kMembers = 24;    // effects that are tried in pairs: 276 of them
constexpr std::size_t kTriedPairs = 3;  // that are tried before a round gives up

/// An effect that may be one of a pair, and where its columns are among those of all.
struct Member {
  std::size_t hypothesis;
  const TrialScore* trial;
  std::vector<Index> columns;
};

std::vector<Member> members_of(const EffectRecordings& data,
                               const std::vector<Hypothesis>& hypotheses,
                               const Screening& screening, const CompetitionResult& result) {
  std::vector<Member> members;
  for (const NamedResult& named : screening.named) {
    const Hypothesis& hypothesis = hypotheses[named.hypothesis];
    if (!named.seen || hypothesis.windowed || is_winner(result, named.hypothesis)) continue;
    if (joints_of(hypothesis.effect, data.joints()).size() < 2) continue;
    members.push_back({named.hypothesis, &named.freest, {}});
  }
  std::stable_sort(members.begin(), members.end(), [](const Member& a, const Member& b) {
    return a.trial->score.delta_chi2 > b.trial->score.delta_chi2;
  });
  if (members.size() > kMembers) members.resize(kMembers);
  return members;
}

/// Columns of all members, which learn where theirs are.
JointColumns columns_of(const EffectRecordings& data, EffectSignals& signals,
                        const EvidenceSystem& system, const std::vector<Hypothesis>& hypotheses,
                        std::vector<Member>& members) {
  std::vector<JointColumns> sets;
  Index width = 0;
  for (Member& member : members) {
    sets.push_back(hypothesis_columns(data, signals, system, hypotheses[member.hypothesis],
                                      member.trial->effect));
    member.columns.resize(static_cast<std::size_t>(sets.back().columns()));
    std::iota(member.columns.begin(), member.columns.end(), width);
    width += sets.back().columns();
  }
  return side_by_side(sets);
}

Score score_of_columns(const Products& products, const std::vector<Index>& columns) {
  return score_of({products.whole(columns, columns),
                   products.left(columns, columns),
                   products.rest(columns),
                   {}},
                  false);
}

}  // namespace

std::vector<EffectPair> strongest_pairs(const EffectRecordings& data, EffectSignals& signals,
                                        const EvidenceSystem& system,
                                        const std::vector<Hypothesis>& hypotheses,
                                        const Screening& screening,
                                        const CompetitionResult& result) {
  std::vector<Member> members = members_of(data, hypotheses, screening, result);
  const Products products =
      system.products(columns_of(data, signals, system, hypotheses, members), false);
  const double tried = std::log(static_cast<double>(std::max<std::size_t>(members.size(), 1)));
  std::vector<EffectPair> pairs;
  for (std::size_t a = 0; a < members.size(); ++a) {
    const Score alone = score_of_columns(products, members[a].columns);
    for (std::size_t b = a + 1; b < members.size(); ++b) {
      std::vector<Index> columns = members[a].columns;
      columns.insert(columns.end(), members[b].columns.begin(), members[b].columns.end());
      const Score both = score_of_columns(products, columns);
      const Score other = score_of_columns(products, members[b].columns);
      EffectPair pair;
      pair.stronger = members[a].hypothesis;
      pair.weaker = members[b].hypothesis;
      pair.net = both.delta_chi2 -
                 price_of(hypotheses[pair.stronger], *members[a].trial, result.noise) -
                 price_of(hypotheses[pair.weaker], *members[b].trial, result.noise);
      const auto beside = [&](const Score& single) {
        const int degrees = both.degrees - single.degrees;
        return degrees > 0 ? surprise_of(both.delta_chi2 - single.delta_chi2, degrees) : 0;
      };
      pair.surprise = std::max(std::min(beside(alone), beside(other)) - tried, 0.0);
      pairs.push_back(pair);
    }
  }
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const EffectPair& a, const EffectPair& b) { return a.net > b.net; });
  return pairs;
}

std::vector<EffectPair> PairSearch::strongest(const EvidenceSystem& system,
                                              const Screening& screening) const {
  if (!stiction_.strongest(system, screening).empty()) return {};
  std::vector<EffectPair> pairs = strongest_pairs(data_.evidence, data_.signals, system,
                                                  sought_.hypotheses, screening, result_);
  pairs.resize(std::min(pairs.size(), kTriedPairs));
  return pairs;
}

bool PairSearch::promising(const EffectPair& pair, const EvidenceSystem& system,
                           const Screening& screening) const {
  if (pair.net <= 0 || screening.family_wise(pair.surprise) > false_alarm_) return false;
  std::vector<int> joints = sought_.joints(pair.stronger);
  const std::vector<int> others = sought_.joints(pair.weaker);
  joints.insert(joints.end(), others.begin(), others.end());
  if (conditions_.beside(pair.net, joints, system, screening) ==
      EffectConditions::Beside::kOutdone) {
    return false;
  }
  const auto stopped = [&](std::size_t place) {
    return stiction_.explain(system, screening, sought_.hypotheses[place],
                             without_conditions(screening.named[place]));
  };
  return !stopped(pair.weaker) && !stopped(pair.stronger);
}

}  // namespace dyngen::runtime
