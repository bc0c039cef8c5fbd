// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/recordings/reader.h"

namespace dyngen::runtime {

struct StretchOptions {
  double seconds = 10;  ///< of a stretch
  /// Of time, q and tau that are kept, as of worth_of_row(): 77 s of six joints at 1 kHz, for
  /// which a diagnosis takes half a minute.
  double most_numbers = 1e6;
  int parts = 20;  ///< equal parts of the time, which give stretches in turn
};

/// How many rows at 1 kHz a row stands for: 1 at that rate and above, 4 at 250 Hz and below.
/// Equations are decimated to the band of the motion, so that rows of slow recordings give more.
double worth_of_row(double sample_time);

/// Numbers of rows with time, q and tau of all joints, as StretchOptions::most_numbers counts them.
/// @param sample_time  s
double numbers_of_rows(Eigen::Index rows, int joints, double sample_time);

/// A long recording by the stretches that say most.
struct Stretches {
  Recording recording;  ///< a run for each stretch; stretches that follow each other are one
  /// s since the start of the recording: first and last sample of each
  std::vector<std::pair<double, double>> times;
  double start = 0;  ///< s, time stamp of the first sample of the whole recording
  double seconds_in_all = 0;
  std::string sentence;  ///< how many, and which
};

/// Goes through the recording twice. Every joint j has six simple parts of torque, x_j = (ddq_j,
/// dq_j, sign dq_j, sin q_j, cos q_j, 1), each divided by its rms over the whole recording. The
/// first pass sums up A_js = sum x_j x_j^T of each stretch s; then that stretch is taken which
/// raises sum_j log det(sum_s A_js + I) most, again and again (a greedy D-optimal
/// choice), until memory is full. The second pass reads those.
///
/// Each choice is among the parts of the time that have given fewest stretches. A change over
/// minutes or hours therefore shows, however alike the motion is. Samples keep their time stamps.
///
/// @param notices  what was repaired is appended, if not null
/// @throws RecordingError
Stretches telling_stretches(const RecordingInput& input, const ReadOptions& reading,
                            const StretchOptions& options, std::vector<Notice>* notices);

}  // namespace dyngen::runtime
