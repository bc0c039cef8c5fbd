// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

/// A motion that repeats, found in the longest run of a recording.
struct Periods {
  Eigen::Index samples = 0;  ///< per period, the nearest whole number; 0: none found
  double period = 0;         ///< s, finer than a sample
  int count = 0;             ///< whole periods, from the first row of the run
  double correlation = 0;    ///< of positions a period apart, of the joint that repeats worst
  std::string message;       ///< a sentence: what was found, or why nothing
  Eigen::Index first = 0;    ///< row of the recording where the first period begins
};

/// Looks for the shortest period with which all moving joints repeat, from the positions alone.
///
/// They repeat if positions a period apart differ by no more than noise and quantisation explain,
/// or by 1 % (rms) of the motion's standard deviation times sqrt(2); at least two whole periods
/// must be there.
/// @param given  s: the period is known; it is only checked
/// @throws std::invalid_argument if `given` is not positive
Periods find_periods(const Recording& recording, std::optional<double> given = {});

/// One period: the mean over all whole periods, Periods::samples rows from the time of the first.
///
/// Where the period is no whole number of samples, or these are not uniform, all signals are
/// brought to a whole number by cubic spline first.
/// @throws std::invalid_argument if `periods` says that there are none, or is of another recording
Recording average_periods(const Recording& recording, const Periods& periods);

/// (samples x n) N m: standard deviation of tau over the periods at each phase; the noise of torque
/// without any model. Its rms over the rows is the noise of each joint.
Eigen::MatrixXd period_scatter(const Recording& recording, const Periods& periods);

/// (1 x n) root of the mean square of each column.
Eigen::RowVectorXd column_rms(const Eigen::Ref<const Eigen::MatrixXd>& values);

}  // namespace dyngen::runtime
