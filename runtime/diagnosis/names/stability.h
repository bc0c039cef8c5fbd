// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// What competes for a name.
struct Contender {
  JointColumns columns;  ///< as EvidenceSystem::whitened() gives them
  double price = 0;      ///< penalty of its parameters
};

/// How often each contender explains most where half of the recordings is left out: of a hundred
/// random halves of their stretches, by the chi-square reduction net of penalties.
/// @return (contenders) shares, sum 1
/// Source: Meinshausen and Buehlmann, J. R. Statist. Soc. B 72, 2010 (stability selection).
std::vector<double> selected_shares(const EvidenceSystem& system,
                                    const std::vector<Contender>& contenders, std::uint64_t seed);

}  // namespace dyngen::runtime
