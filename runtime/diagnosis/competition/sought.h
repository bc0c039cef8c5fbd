// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "runtime/diagnosis/competition/tie_rule.h"
#include "runtime/diagnosis/scans/generic_structure.h"
#include "runtime/diagnosis/scans/screening.h"
#include "runtime/evidence/torque_noise_model.h"

namespace dyngen::runtime {

/// What a competition looks for in the torque of one robot.
struct Sought {
  const std::vector<Hypothesis>& hypotheses;  ///< effects that have a name; they outlive it
  std::vector<GenericStructure> structures;   ///< functions of the motion that have none
  ScaleTable scales;                          ///< by which typical sizes of effects are computed

  /// Joints on which the columns of a hypothesis act.
  [[nodiscard]] std::vector<int> joints(std::size_t hypothesis) const;
  /// Linear parameters and shapes of a hypothesis.
  [[nodiscard]] std::size_t parameters(std::size_t hypothesis) const;
  /// net_of() the best trial.
  [[nodiscard]] double net(const NamedResult& named, const TorqueNoiseModel& noise) const;
  /// Where an effect stands among others, by the same.
  [[nodiscard]] Standing standing(const NamedResult& named, const TorqueNoiseModel& noise) const;
};

/// @param evidence  recordings whose motion gives the scales; its model outlives the result
Sought sought_in(const EffectRecordings& evidence, const std::vector<Hypothesis>& hypotheses);
Sought sought_in(const EffectRecordings& evidence,
                 const std::vector<Hypothesis>&& hypotheses) = delete;

}  // namespace dyngen::runtime
