// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/changes/change_posterior.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace dyngen::runtime {
namespace {

constexpr std::size_t kKept = 16;   // sets of each size from which the next ones grow
constexpr double kNegligible = 20;  // log evidence below the best: a set without weight, 2e-9

/// Sets with their log evidence, each looked at once.
class SetWalk {
 public:
  explicit SetWalk(const ChangeSystem& system) : system_(system) {}

  ChangePosterior run() {
    std::vector<ChangeSet> layer = {{}};
    evidence_of({});
    const auto most = static_cast<std::size_t>(system_.rules().most_changes);
    for (std::size_t size = 1; size <= most && !layer.empty(); ++size) {
      layer = grown(layer);
    }
    shrink();
    ChangePosterior posterior;
    double sum = 0;
    for (const auto& [set, value] : values_) sum += std::exp(value - best_);
    for (const auto& [set, value] : values_) {
      posterior.weights[set] = std::exp(value - best_) / sum;
      if (value == best_) posterior.best = set;
    }
    return posterior;
  }

 private:
  [[nodiscard]] bool has_candidate(const ChangeSet& set, std::size_t form) const {
    return std::any_of(set.begin(), set.end(), [&](std::size_t own) {
      return system_.forms()[own].candidate == system_.forms()[form].candidate;
    });
  }

  /// -inf: no better than what is not worth a closer look.
  double evidence_of(const ChangeSet& set) {
    const auto [place, added] = values_.try_emplace(set, -INFINITY);
    if (!added) return place->second;
    if (system_.upper_bound(set) < best_ - kNegligible) return place->second;
    place->second = system_.log_evidence(set);
    best_ = std::max(best_, place->second);
    return place->second;
  }

  std::vector<ChangeSet> grown(const std::vector<ChangeSet>& layer) {
    std::vector<std::pair<double, ChangeSet>> bounds;
    std::set<ChangeSet> seen;
    for (const ChangeSet& set : layer) {
      for (std::size_t f = 0; f < system_.forms().size(); ++f) {
        if (has_candidate(set, f)) continue;
        ChangeSet next = set;
        next.insert(std::upper_bound(next.begin(), next.end(), f), f);
        if (!seen.insert(next).second) continue;
        bounds.emplace_back(system_.upper_bound(next), std::move(next));
      }
    }
    std::stable_sort(bounds.begin(), bounds.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<std::pair<double, ChangeSet>> judged;
    const double before = best_;
    for (std::size_t i = 0; i < bounds.size() && i < 4 * kKept; ++i) {
      const double value = evidence_of(bounds[i].second);
      if (std::isfinite(value)) judged.emplace_back(value, bounds[i].second);
    }
    std::stable_sort(judged.begin(), judged.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<ChangeSet> next;
    for (const auto& [value, set] : judged) {
      if (next.size() < kKept) next.push_back(set);
    }
    // a second change may show only beside a third: one layer without gain is looked beyond
    idle_ = best_ > before ? 0 : idle_ + 1;
    if (idle_ > 1) next.clear();
    return next;
  }

  /// The best set without one of its changes, with another form of it, or another in its place.
  void shrink() {
    for (bool better = true; better;) {
      const double before = best_;
      const ChangeSet best =
          std::max_element(values_.begin(), values_.end(), [](const auto& a, const auto& b) {
            return a.second < b.second;
          })->first;
      for (std::size_t i = 0; i < best.size(); ++i) {
        ChangeSet fewer = best;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
        evidence_of(fewer);
        for (std::size_t f = 0; f < system_.forms().size(); ++f) {
          if (has_candidate(fewer, f)) continue;
          ChangeSet other = fewer;
          other.insert(std::upper_bound(other.begin(), other.end(), f), f);
          evidence_of(other);
        }
      }
      better = best_ > before;
    }
  }

  const ChangeSystem& system_;
  std::map<ChangeSet, double> values_;
  double best_ = -INFINITY;
  int idle_ = 0;
};

bool has(const ChangeSystem& system, const ChangeSet& set, const ChangeCandidate& candidate) {
  return std::any_of(set.begin(), set.end(), [&](std::size_t f) {
    return is_same_name(system.candidates()[system.forms()[f].candidate], candidate);
  });
}

}  // namespace

bool is_same_name(const ChangeCandidate& a, const ChangeCandidate& b) {
  return a.families.front() == b.families.front() && a.effect.joint == b.effect.joint &&
         a.effect.link == b.effect.link && a.effect.other == b.effect.other &&
         a.both_sides == b.both_sides;
}

double ChangePosterior::probability(const ChangeSystem& system, std::size_t candidate) const {
  double sum = 0;
  for (const auto& [set, weight] : weights) {
    if (has(system, set, system.candidates()[candidate])) sum += weight;
  }
  return std::min(1.0, sum);
}

std::vector<std::size_t> ChangePosterior::replacements(const ChangeSystem& system,
                                                       std::size_t candidate) const {
  ChangeSet rest;
  for (const std::size_t f : best) {
    if (system.forms()[f].candidate != candidate) rest.push_back(f);
  }
  std::map<std::size_t, double> found;
  for (const auto& [set, weight] : weights) {
    if (set.size() != best.size() || weight < system.rules().replaces * weights.at(best)) continue;
    if (has(system, set, system.candidates()[candidate])) continue;
    // one in its place, the others with whatever form
    std::vector<std::size_t> others, own;
    for (const std::size_t f : rest) own.push_back(system.forms()[f].candidate);
    for (const std::size_t f : set) {
      const std::size_t other = system.forms()[f].candidate;
      if (std::find(own.begin(), own.end(), other) == own.end()) others.push_back(other);
    }
    const bool change = others.size() == 1 && !system.candidates()[others.front()].both_sides;
    if (change) found[others.front()] += weight;
  }
  std::vector<std::size_t> places;
  for (const auto& [place, weight] : found) places.push_back(place);
  std::stable_sort(places.begin(), places.end(),
                   [&](std::size_t a, std::size_t b) { return found.at(a) > found.at(b); });
  return places;
}

double ChangePosterior::probability_of_any(const ChangeSystem& system,
                                           std::size_t candidate) const {
  const std::vector<std::size_t> others = replacements(system, candidate);
  double sum = 0;
  for (const auto& [set, weight] : weights) {
    const ChangeSet& own = set;
    const bool any = has(system, own, system.candidates()[candidate]) ||
                     std::any_of(others.begin(), others.end(), [&](std::size_t other) {
                       return has(system, own, system.candidates()[other]);
                     });
    if (any) sum += weight;
  }
  return std::min(1.0, sum);
}

ChangePosterior change_posterior(const ChangeSystem& system) { return SetWalk(system).run(); }

}  // namespace dyngen::runtime
