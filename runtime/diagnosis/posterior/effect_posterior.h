// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "runtime/diagnosis/posterior/set_evidence.h"

namespace dyngen::runtime {

struct PosteriorOptions {
  std::size_t most = 24;  ///< candidates in a set
  int steps = 3000;       ///< of each chain
  std::uint64_t seed = 20261121;
};

struct WeightedSet {
  CandidateSet set;
  double probability = 0;
};

/// Which sets of candidates the data support: those that were seen, the most probable first.
struct EffectPosterior {
  std::vector<WeightedSet> sets;

  /// 0 .. 1: probability that some candidate of the set is one of these.
  [[nodiscard]] double probability(const std::function<bool(std::size_t)>& is_one) const;
  /// 0 .. 1: that there is any.
  [[nodiscard]] double any() const;
};

/// Walks over sets of candidates by Metropolis steps and by draws of one place given the others
/// (George and McCulloch 1993; Madigan and York 1995), from the empty set and from the set that
/// grows best, and gives each set that it saw its share of their evidence.
EffectPosterior effect_posterior(const SetEvidence& evidence, const PosteriorOptions& options = {});

}  // namespace dyngen::runtime
