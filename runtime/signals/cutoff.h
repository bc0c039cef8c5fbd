// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// A cut-off frequency for the filter that gives velocity and acceleration, and why.
struct Cutoff {
  double hz = 0;
  std::string message;
};

/// Chooses the cut-off from the data. The spectrum of each joint's acceleration (averaged
/// periodogram of second differences; they take the trend away and keep slow, large motion from
/// leaking over the noise) falls with frequency where the joint is moved and rises, as w^4 if the
/// position noise is white, where there is noise. So the noise is taken as the largest rising
/// function below the spectrum (a third of an octave smooth); vibration that rises with frequency
/// counts as noise too. Motion ends where the spectrum stays below twice that, signal to noise
/// below one, for half an octave; it goes on above such a gap if more than 1 % of the velocity's
/// power is there (then the frequency is taken where a sharp low-pass loses and passes least in
/// sum). The largest of the joints that move (by more than noise, and than a thousandth of what the
/// farthest one does: a drive that holds its joint gives way), times 2 since a filter's edge is not
/// sharp, between 2 Hz and a fifth of the sampling frequency.
///
/// All runs have one spectrum, the mean over pieces of one length, a quarter of the longest run or
/// shorter: a run that is shorter than a piece decides nothing.
///
/// @param runs         positions of each run, (N x n), uniformly sampled; one has 64 samples or
/// more
/// @param sample_time  s, > 0
/// @return             hz; message says what was found in a sentence, also if nothing moves (2 Hz)
///                     or no noise is seen (a fifth of the sampling frequency)
/// @throws std::invalid_argument  if all N < 64, n < 1 or differs, or sample_time is not positive
Cutoff choose_cutoff(const std::vector<Eigen::MatrixXd>& runs, double sample_time);
/// The same of one run.
Cutoff choose_cutoff(const Eigen::MatrixXd& q, double sample_time);

/// Lowest cut-off that is chosen, Hz: robots move at about a hertz.
inline constexpr double kLowestCutoff = 2;
/// Highest cut-off that is chosen, as a part of the sampling frequency: differences of positions
/// are derivatives to some per cent up to there.
inline constexpr double kHighestCutoff = 0.2;

}  // namespace dyngen::runtime
