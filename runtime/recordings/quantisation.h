// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// The step in which a signal was measured (an encoder count, a converter's bit).
struct Quantisation {
  double step = 0;      ///< in the signal's unit; 0: none found
  double fraction = 0;  ///< 0..1 of the small changes that are whole multiples of it
  /// The step is just the last printed decimal (10^-k): it says how the file was written, not how
  /// the signal was measured.
  bool print_resolution = false;
};

/// Looks for the largest step of which nearly all changes from sample to sample are multiples.
///
/// Robust to rounding of printed values (if the step is some times the last decimal), to outliers,
/// and to a slow drift below a tenth of the step. Wants some 30 changes of fewer than 50 steps.
/// @param signal  (N) one column of a recording, as measured: filtered signals have no step
Quantisation find_quantisation(const Eigen::Ref<const Eigen::VectorXd>& signal);

}  // namespace dyngen::runtime
