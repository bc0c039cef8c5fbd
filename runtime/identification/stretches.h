// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/recordings/reader.h"

namespace dyngen::runtime {

struct StretchOptions {
  double seconds = 10;  ///< of a stretch
  /// Of time, q and tau that are kept: 77 s of six joints at 1 kHz, which a diagnosis takes half a
  /// minute for.
  std::size_t most_numbers = 1'000'000;
};

/// A recording that is too long for memory, by the stretches that say most.
struct Stretches {
  Recording recording;  ///< a run for each stretch; stretches that follow each other are one
  std::vector<std::pair<double, double>> times;  ///< s, first and last sample of each
  double seconds_in_all = 0;
  std::string sentence;  ///< how many, and which
};

/// Goes through the recording twice. Every joint j has six simple parts of torque, x_j = (ddq_j,
/// dq_j, sign dq_j, sin q_j, cos q_j, 1), each divided by its rms over the whole recording. The
/// first pass sums up A_js = sum x_j x_j^T of each stretch s; then that stretch is taken which
/// raises sum_j log det(sum_s A_js + I) most, again and again (a greedy D-optimal
/// choice), until memory is full. The second pass reads those.
///
/// @param notices  what was repaired is appended, if not null
/// @throws RecordingError
Stretches telling_stretches(const RecordingInput& input, const ReadOptions& reading,
                            const StretchOptions& options, std::vector<Notice>* notices);

}  // namespace dyngen::runtime
