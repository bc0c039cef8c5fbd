// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// The chi-square of a torque that other columns and the model cannot imitate, and its whole
/// chi-square: lambda (1 - c^2) and lambda.
struct Imitation {
  double left = 0, whole = 0;
};

/// @param torque  one whitened column   @param other  whitened columns
Imitation imitation(const EvidenceSystem& system, const JointColumns& torque,
                    const JointColumns& other);

}  // namespace dyngen::runtime
