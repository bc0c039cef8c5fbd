// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// Squares of a torque that other columns cannot imitate beside the model, and all of it:
/// lambda (1 - c^2) and lambda.
struct Imitation {
  double left = 0, whole = 0;
};

/// @param torque  one whitened column   @param other  whitened columns
Imitation imitation(const EvidenceSystem& system, const JointColumns& torque,
                    const JointColumns& other);

}  // namespace dyngen::runtime
