// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "runtime/recordings/recording.h"

namespace dyngen::runtime {

/// A run of which everything is known.
struct TestMotion {
  Eigen::VectorXd time;
  Eigen::MatrixXd q, dq, ddq;
};

/// Five lines 0.5, 1.2, 2.1, 3.3, 5 Hz in each joint; 10 s are whole periods.
inline TestMotion test_motion(Eigen::Index N, double T, int joints) {
  TestMotion motion{Eigen::VectorXd(N), Eigen::MatrixXd::Zero(N, joints),
                    Eigen::MatrixXd::Zero(N, joints), Eigen::MatrixXd::Zero(N, joints)};
  const double lines[] = {0.5, 1.2, 2.1, 3.3, 5};
  for (Eigen::Index k = 0; k < N; ++k) {
    const double t = T * static_cast<double>(k);
    motion.time[k] = t;
    for (int j = 0; j < joints; ++j) {
      motion.q(k, j) = 0.2 * j - 0.3;
      for (const double hz : lines) {
        const double w = 2 * std::numbers::pi * hz, a = 0.4 / (w + j), phase = w * t + 3 * hz + j;
        motion.q(k, j) += a * std::sin(phase);
        motion.dq(k, j) += a * w * std::cos(phase);
        motion.ddq(k, j) -= a * w * w * std::sin(phase);
      }
    }
  }
  return motion;
}

/// What an encoder with this step makes of it; no velocity in it, tau a mark on each sample.
inline Recording test_recording(const TestMotion& motion, double step) {
  Recording recording;
  recording.time = motion.time;
  recording.q = step > 0 ? (step * (motion.q / step).array().round()).matrix().eval() : motion.q;
  recording.tau = recording.q;
  for (Eigen::Index k = 0; k < motion.time.size(); ++k) {
    recording.tau.row(k).setConstant(static_cast<double>(k));
  }
  recording.run_starts = {0};
  return recording;
}

/// Rows of a recording as one run that begins at its own time.
inline Recording rows_of(const Recording& recording, Eigen::Index from, Eigen::Index count) {
  Recording rows;
  rows.time = recording.time.segment(from, count);
  rows.q = recording.q.middleRows(from, count);
  rows.tau = recording.tau.middleRows(from, count);
  rows.run_starts = {0};
  return rows;
}

}  // namespace dyngen::runtime
