// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/diagnosis/scans/generic_structure.h"
#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// The strongest of the waves of two positions that are looked at.
struct WaveScan {
  Eigen::Vector2d frequency = Eigen::Vector2d::Zero();  ///< 1/rad or 1/m
  Score score;  ///< surrogates: the largest of all waves that were looked at
};

/// Whole numbers of half waves over the range of each of two positions, both ways; behind the
/// parallel filter, the same for every joint on which they may act.
struct Waves {
  Eigen::Matrix2Xd frequencies;  ///< (2 x m) 1/rad or 1/m; none where a position does not move
  Eigen::MatrixXd shapes;        ///< (equations x 2m) as of wave_shapes()
};
Waves waves_of(const EffectRecordings& data, int first, int second);

WaveScan scan_waves(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                    const Waves& waves, bool surrogates);

}  // namespace dyngen::runtime
