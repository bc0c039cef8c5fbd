// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace dyngen::test {

/// A robot whose plant has an effect, recorded for 20 s with white noise and exact positions, and
/// then once more.
struct AliasCase {
  std::string effect;  ///< a row of a robot file
  std::string family;  ///< of it
  double noise = 1;    ///< N m
  double size = 1;     ///< of the first motion, as MultisineOptions
  double next = 20;    ///< s of the second recording, two periods
  int seeds = 20;      ///< of motion and noise
  int evaluations = 250;
};

/// How often a recording more makes several names one.
struct AliasFigures {
  int several = 0;         ///< of the seeds: one finding, of several names, the true one among them
  int wrong_first = 0;     ///< of these: the true one was not the first
  int designed = 0;        ///< of these: the true name alone with the designed motion
  int another = 0;         ///< with another motion like the first
  double median_gain = 0;  ///< separation over that of a random motion
};
AliasFigures alias_figures(const AliasCase& asked);

}  // namespace dyngen::test
