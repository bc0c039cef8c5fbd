// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

/// How regularly a recording was sampled.
struct TimeBase {
  double sample_time = 0;  ///< s: the median step; the mean one if uniform (printed times round it)
  double jitter = 0;       ///< rms of (step - sample_time) / sample_time
  double worst_step = 0;   ///< s: the step that is farthest from sample_time
  bool uniform = false;    ///< every run is on an equidistant grid, all with one sample time
  std::string message;     ///< a sentence that says so
};

/// Looks at the steps within runs.
///
/// Uniform: no sample is more than 1 % of a step off its run's grid, beyond what rounding of the
/// printed times explains (half a unit of their last decimal).
TimeBase examine_time_base(const Recording& recording);

/// Every run on a uniform grid of its own: time is start + k * sample_time exactly.
///
/// q, dq, ddq by cubic spline; tau, tau_sim, temperature along straight lines, since a spline
/// amplifies noise. Use it only when the time base is not uniform. No filter is applied: a larger
/// sample time than the recording's folds noise down.
/// @throws std::invalid_argument if sample_time is not positive, or time does not increase in a run
Recording resample(const Recording& recording, double sample_time);

/// First row of the run after run `run` (0-based): its rows are [run_starts[run], run_end).
Eigen::Index run_end(const Recording& recording, std::size_t run);

/// The unit of the last printed decimal: the largest 10^-k, k = 0 .. 12, of which all values are
/// multiples; 0 if there is none.
double print_unit(const Eigen::Ref<const Eigen::VectorXd>& values);

}  // namespace dyngen::runtime
