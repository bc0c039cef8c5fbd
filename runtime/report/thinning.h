// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// Long signals over one time as a chart needs them: of every slice of samples the least and the
/// largest value of each, so that no peak is lost.
struct ThinnedSignals {
  Eigen::VectorXd x;  ///< ascending
  Eigen::MatrixXd y;  ///< (x.size() x signals)
};

/// @param x  (N) ascending        @param y  (N x signals)
/// @param slices  at least 1; of up to twice as many samples all are kept
/// @return  two values a slice, in the order in which a signal has them; their x are those of the
///          slice's first sample and of one in its middle. NaN only where all of a slice is NaN
/// @throws std::invalid_argument  for another number of rows, or less than one slice
ThinnedSignals thinned_signals(const Eigen::VectorXd& x, const Eigen::MatrixXd& y,
                               Eigen::Index slices);

/// Groups of samples that are close together in a variable.
struct Bins {
  Eigen::VectorXd x;             ///< (bins) mean of the variable, ascending
  std::vector<Eigen::Index> of;  ///< (N) bin of each sample
};

/// Bins that are narrow where there are many samples and where the eye should look: their number
/// is shared equally among the samples, the length of the axis, and the range.
/// @param x         (N) not empty, finite
/// @param from, to  the range; to <= from: none
/// @param most      at least 1
Bins bins_of(const Eigen::VectorXd& x, double from, double to, Eigen::Index most);

/// What lies in bins.
struct BinnedValues {
  Eigen::VectorXd mean;       ///< (bins) NaN where there are less than `least` samples
  Eigen::VectorXd low, high;  ///< (bins) quantiles 0.25 and 0.75
};
/// @param chosen  (N) samples that count; empty: all
BinnedValues binned(const Bins& bins, const Eigen::VectorXd& y, const std::vector<bool>& chosen,
                    Eigen::Index least = 5);

/// Places of samples to be drawn: one of each of `most` slices, and the largest of y, ascending.
/// @param y  (N)
std::vector<Eigen::Index> drawn_samples(const Eigen::VectorXd& y, Eigen::Index most);

}  // namespace dyngen::runtime
