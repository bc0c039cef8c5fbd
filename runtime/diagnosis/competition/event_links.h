// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <set>

#include "runtime/diagnosis/competition/effect_conditions.h"

namespace dyngen::runtime {

/// Part of a winner's chi-square reduction from which another effect is tried in its place.
constexpr double kLeastAsGood = 0.5;

/// On which link a force acts.
class EventLinks {
 public:
  /// All of them have to outlive it.
  /// @param false_alarm  of the whole diagnosis   @param result  what was found so far
  EventLinks(const CompetitionData& data, const Sought& sought, const EffectConditions& conditions,
             double false_alarm, const CompetitionResult& result)
      : data_(data),
        sought_(sought),
        conditions_(conditions),
        false_alarm_(false_alarm),
        result_(result) {}

  /// A force that seems to act on a link whose own joint carries no torque acts on the link before
  /// it. The force is constant between two times in the model, and seldom in the world: the link
  /// further out has more parameters, and explains more of its course.
  /// @param named    any effect; what is no force on a link comes back as it is
  /// @param refused  hypotheses that were turned down in this round
  [[nodiscard]] NamedResult on_nearest(NamedResult named, const EvidenceSystem& system,
                                       const Screening& screening,
                                       const std::set<std::size_t>& refused) const;

 private:
  [[nodiscard]] EvidenceSystem beside_same_event(const EvidenceSystem& system,
                                                 const Hypothesis& other, const Hypothesis& own,
                                                 const EffectInstance& event) const;

  const CompetitionData& data_;
  const Sought& sought_;
  const EffectConditions& conditions_;
  double false_alarm_;
  const CompetitionResult& result_;
};

}  // namespace dyngen::runtime
