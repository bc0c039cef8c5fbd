// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/posterior/effect_posterior.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kFirstOfPairs = 25;  // candidates beside which a second is looked for
constexpr double kAlike = 0.5;             // likeness from which one is tried for the other
constexpr std::size_t kReplacements = 60;  // sets that a draw of one place keeps
// Parts of the steps: a draw of a place, one more or one less, one less; the rest replace one.
constexpr double kDraw = 0.02, kToggle = 0.35, kDrop = 0.15;

CandidateSet with(CandidateSet set, std::size_t place) {
  set.insert(std::upper_bound(set.begin(), set.end(), place), place);
  return set;
}

CandidateSet without(CandidateSet set, std::size_t place) {
  std::erase(set, place);
  return set;
}

bool has(const CandidateSet& set, std::size_t place) {
  return std::binary_search(set.begin(), set.end(), place);
}

/// Places of the largest values that are finite, the largest first.
std::vector<std::size_t> largest(const VectorXd& values, std::size_t count) {
  std::vector<std::size_t> places;
  for (Index i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) places.push_back(static_cast<std::size_t>(i));
  }
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) {
    return values[static_cast<Index>(a)] > values[static_cast<Index>(b)];
  });
  if (places.size() > count) places.resize(count);
  return places;
}

class Walk {
 public:
  Walk(const SetEvidence& evidence, const PosteriorOptions& options)
      : evidence_(evidence), options_(options), random_(options.seed) {
    const MatrixXd likeness = evidence.likeness();
    for (Index i = 0; i < likeness.rows(); ++i) {
      std::vector<std::size_t> alike;
      for (Index j = 0; j < likeness.cols(); ++j) {
        if (j != i && likeness(i, j) > kAlike) alike.push_back(static_cast<std::size_t>(j));
      }
      alike_.push_back(std::move(alike));
    }
    const VectorXd alone = evidence.with_each({});
    const double most = alone.maxCoeff();
    double sum = 0;
    for (const double each : alone) {
      sum += std::exp(std::max(each - most, -30.0)) + 1e-4;
      proposal_.push_back(sum);
    }
  }

  EffectPosterior run() {
    for (const CandidateSet& start : {grown(), CandidateSet{}}) {
      set_ = start;
      log_ = evidence_of(set_);
      for (int step = 0; step < options_.steps; ++step) move();
    }
    return shares();
  }

 private:
  double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(uniform() * static_cast<double>(count)));
  }
  std::size_t any_candidate() {
    if (uniform() < 0.3) return below(evidence_.size());
    const double value = uniform() * proposal_.back();
    const auto found = std::upper_bound(proposal_.begin(), proposal_.end(), value);
    return std::min(evidence_.size() - 1, static_cast<std::size_t>(found - proposal_.begin()));
  }

  double evidence_of(const CandidateSet& set) {
    const auto [entry, added] = seen_.try_emplace(set, 0);
    if (added) entry->second = evidence_.of(set);
    return entry->second;
  }

  /// One after another as long as the evidence grows, or two at once; what no longer pays leaves.
  CandidateSet grown() {
    CandidateSet set;
    while (set.size() < options_.most) {
      const VectorXd all = evidence_.with_each(set);
      const double base = evidence_of(set);
      Index best = 0;
      if (all.maxCoeff(&best) > base) {
        set = shrunk(with(set, static_cast<std::size_t>(best)));
        continue;
      }
      CandidateSet pair;
      double most = base;
      for (const std::size_t first : largest(all, kFirstOfPairs)) {
        const CandidateSet one = with(set, first);
        const double both = evidence_.with_each(one).maxCoeff(&best);
        if (both <= most) continue;
        most = both;
        pair = with(one, static_cast<std::size_t>(best));
      }
      if (pair.empty() || pair.size() > options_.most) break;
      set = shrunk(pair);
    }
    return set;
  }

  CandidateSet shrunk(CandidateSet set) {
    for (bool changed = true; changed;) {
      changed = false;
      for (const std::size_t place : set) {
        CandidateSet fewer = without(set, place);
        if (evidence_of(fewer) <= evidence_of(set)) continue;
        set = std::move(fewer);
        changed = true;
        break;
      }
    }
    return set;
  }

  void move() {
    if (!set_.empty() && uniform() < kDraw) return draw_one();
    const double kind = uniform();
    if (set_.empty() || kind < kToggle) {
      const std::size_t place = any_candidate();
      return propose(has(set_, place) ? without(set_, place) : with(set_, place));
    }
    const std::size_t place = set_[below(set_.size())];
    if (kind < kToggle + kDrop) return propose(without(set_, place));
    const std::vector<std::size_t>& alike = alike_[place];
    const std::size_t other =
        !alike.empty() && uniform() < 0.7 ? alike[below(alike.size())] : any_candidate();
    if (!has(set_, other)) propose(with(without(set_, place), other));
  }

  void propose(CandidateSet next) {
    if (next.size() > options_.most) return;
    const double log = evidence_of(next);
    if (std::log(std::max(uniform(), 1e-300)) >= log - log_) return;
    set_ = std::move(next);
    log_ = log;
  }

  /// What stands in one place, or nothing, given the others.
  void draw_one() {
    const CandidateSet rest = without(set_, set_[below(set_.size())]);
    const VectorXd all = evidence_.with_each(rest);
    std::vector<std::pair<double, CandidateSet>> options = {{evidence_of(rest), rest}};
    for (const std::size_t place : largest(all, kReplacements)) {
      CandidateSet next = with(rest, place);
      const double log = all[static_cast<Index>(place)];
      seen_.try_emplace(next, log);
      options.emplace_back(log, std::move(next));
    }
    double most = options.front().first, sum = 0;
    for (const auto& [log, set] : options) most = std::max(most, log);
    for (const auto& [log, set] : options) sum += std::exp(log - most);
    double value = uniform() * sum;
    for (auto& [log, set] : options) {
      value -= std::exp(log - most);
      if (value > 0) continue;
      set_ = std::move(set);
      log_ = log;
      return;
    }
  }

  [[nodiscard]] EffectPosterior shares() const {
    double most = -std::numeric_limits<double>::infinity(), sum = 0;
    for (const auto& [set, log] : seen_) most = std::max(most, log);
    for (const auto& [set, log] : seen_) sum += std::exp(log - most);
    EffectPosterior posterior;
    for (const auto& [set, log] : seen_) {
      const double share = std::exp(log - most) / sum;
      if (share > 0) posterior.sets.push_back({set, share});
    }
    std::stable_sort(
        posterior.sets.begin(), posterior.sets.end(),
        [](const WeightedSet& a, const WeightedSet& b) { return a.probability > b.probability; });
    return posterior;
  }

  const SetEvidence& evidence_;
  const PosteriorOptions& options_;
  std::mt19937_64 random_;
  std::vector<std::vector<std::size_t>> alike_;
  std::vector<double> proposal_;  // sums of what candidates are worth alone
  std::map<CandidateSet, double> seen_;
  CandidateSet set_;
  double log_ = 0;
};

}  // namespace

double EffectPosterior::probability(const std::function<bool(std::size_t)>& is_one) const {
  double sum = 0;
  for (const WeightedSet& each : sets) {
    if (std::any_of(each.set.begin(), each.set.end(), is_one)) sum += each.probability;
  }
  return std::min(1.0, sum);
}

double EffectPosterior::any() const {
  return probability([](std::size_t) { return true; });
}

EffectPosterior effect_posterior(const SetEvidence& evidence, const PosteriorOptions& options) {
  if (evidence.size() == 0) return {{{{}, 1}}};
  return Walk(evidence, options).run();
}

}  // namespace dyngen::runtime
