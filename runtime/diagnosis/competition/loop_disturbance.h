// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "runtime/diagnosis/competition/competition_result.h"

namespace dyngen::runtime {

/// A disturbance inside the control loop, or noise of the positions that the controller follows,
/// where no repeated motion serves as an instrument. Accelerations follow it, so that the residual
/// is correlated with columns of effects: it looks like lateness, like an elasticity of negative
/// stiffness, like a coupling of joints. Its own signature is that innovations of the motion
/// explain the residual (motion_innovations()). An effect that is there leaves none of that beside
/// itself; beside an effect that only resembles the disturbance the signature stays.
class LoopDisturbance {
 public:
  /// @param data, noise   of the evidence; noise of differences between periods is free of it
  /// @param false_alarm   probability that noise alone is taken for a disturbance
  LoopDisturbance(const EffectRecordings& data, const TorqueNoiseModel& noise, double false_alarm);

  /// Joints, from 0, whose equations innovations of the motion explain beside a system.
  [[nodiscard]] std::vector<int> joints_beside(const EvidenceSystem& system) const;

  /// Chi-square reduction of an effect beside the disturbance, on the joints on which it is seen.
  /// @param white  columns of the effect's sizes   @param more  all of its columns, with those of
  /// its shapes: the disturbance must be seen beside these    @return  nothing if it is not seen
  [[nodiscard]] std::optional<Score> beside_it(const EvidenceSystem& system,
                                               const JointColumns& white,
                                               const JointColumns& more) const;

 private:
  std::vector<JointColumns> columns_;  // of each joint that has equations
  double surprise_;                    // from which it is seen on a joint
};

}  // namespace dyngen::runtime
