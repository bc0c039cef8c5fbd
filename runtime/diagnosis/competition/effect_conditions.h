// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"
#include "runtime/diagnosis/competition/stiction_impulses.h"

namespace dyngen::runtime {

/// What an effect has to be beside a model, before the model is fitted with it.
class EffectConditions {
 public:
  /// All of them have to outlive it.
  /// @param result  what was found so far
  EffectConditions(const CompetitionData& data, const Sought& sought,
                   const StictionImpulses& stiction, const CompetitionResult& result)
      : data_(data), sought_(sought), stiction_(stiction), result_(result) {}

  /// Whether what would be an event is a wild value, or too little: nothing held out speaks for it.
  [[nodiscard]] bool is_no_event(const EvidenceSystem& system, const NamedResult& named) const;

  /// Whether an event shows on one of its joints: its columns on this joint alone have a positive
  /// net chi-square, without the penalty of its times. The last joint that carries torque tells the
  /// link of a force (Haddadin, De Luca and Albu-Schaeffer 2017).
  /// @param system  the model and a force on the link before, at the same times: without it, the
  ///                parameters of the model carry the event to other joints
  /// @param joint   coordinate, from 0
  [[nodiscard]] bool carries_torque(const EvidenceSystem& system, const NamedResult& named,
                                    int joint) const;

  /// What without a name stands beside an effect on its joints.
  enum class Beside {
    kNothing,  ///< nothing that explains more
    /// The form of an effect that its file rules out explains more, but the effect explains most of
    /// it: what held-out recordings say of the effect decides, and the form remains a doubt.
    kBetterForm,
    /// A function of the motion explains more, or a ruled-out form by far: the structure is of that
    /// form, or is that of several effects.
    kOutdone
  };
  [[nodiscard]] Beside beside(const NamedResult& named, const EvidenceSystem& system,
                              const Screening& screening) const;
  /// The same of what explains as much, net, on some joints.
  [[nodiscard]] Beside beside(double explained, const std::vector<int>& own,
                              const EvidenceSystem& system, const Screening& screening) const;

 private:
  const CompetitionData& data_;
  const Sought& sought_;
  const StictionImpulses& stiction_;
  const CompetitionResult& result_;
};

}  // namespace dyngen::runtime
