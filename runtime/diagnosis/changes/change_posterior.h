// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "runtime/diagnosis/changes/change_system.h"

namespace dyngen::runtime {

/// Which sets of changes the sessions support.
struct ChangePosterior {
  ChangeSet best;
  std::map<ChangeSet, double> weights;  ///< probability of every set that was looked at

  /// Of a candidate: the probability that its family changed on its joint, whatever the form.
  [[nodiscard]] double probability(const ChangeSystem& system, std::size_t candidate) const;
  /// That it, or one of those that replace it in the best set, changed.
  [[nodiscard]] double probability_of_any(const ChangeSystem& system, std::size_t candidate) const;
  /// Candidates that explain nearly as much in its place, most probable first.
  [[nodiscard]] std::vector<std::size_t> replacements(const ChangeSystem& system,
                                                      std::size_t candidate) const;
};

/// Sets that grow one change at a time from the best ones, and lose one where that is better.
ChangePosterior change_posterior(const ChangeSystem& system);

/// Whether two candidates have one name: a family, on one joint and link.
bool is_same_name(const ChangeCandidate& a, const ChangeCandidate& b);

}  // namespace dyngen::runtime
