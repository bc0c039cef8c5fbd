// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/diagnosis/scans/generic_structure.h"
#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// The strongest of the waves of two positions that are looked at.
struct WaveScan {
  Eigen::Vector2d frequency = Eigen::Vector2d::Zero();  ///< 1/rad or 1/m
  Score score;  ///< surrogates: the largest of all waves that were looked at
};

/// Whole numbers of half waves over the range of each position, both ways.
/// @param structure  of the form kWave
WaveScan scan_waves(const EffectRecordings& data, const EvidenceSystem& system,
                    const GenericStructure& structure, bool surrogates);

}  // namespace dyngen::runtime
