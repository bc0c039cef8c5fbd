// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "runtime/diagnosis/scans/generic_structure.h"
#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// All that comes back in every period of a run up to some frequency, whatever it depends on.
struct RepeatScan {
  double frequency = 0;  ///< Hz, of the band that is the most above noise
  /// The chi-square reduction is divided by that of the lines between the harmonics, per degree of
  /// freedom, where this is more than 1: these lines measure the noise.
  Score score;
  double worth = 0;  ///< degrees of freedom of that level
};

inline constexpr double kWidestRepeatBand = 8;  // Hz

/// Fisher's F of the harmonics of each run against the lines between them, in a quarter, a half and
/// all of the widest band (Schoukens, Vaes, Pintelon 2016). Nothing where no motion repeats.
/// @param repeats  of repeats_of()
RepeatScan scan_repeats(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                        const std::vector<double>& repeats, bool surrogates);

/// A cosine and a sine of each harmonic up to a frequency, of each run by itself; 0 where equations
/// are too seldom for it.
/// @param aside  of the distance from one harmonic to the next: 0 harmonics, 0.5 halfway between
JointColumns harmonic_columns(const EffectRecordings& data, int joint,
                              const std::vector<double>& repeats, double frequency,
                              double aside = 0);

}  // namespace dyngen::runtime
