// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/recordings/notice.h"
#include "runtime/recordings/reader.h"

namespace dyngen::runtime {

/// A motion that a robot is asked to make: one row a sample, SI units, joint side.
struct Trajectory {
  Eigen::VectorXd time;  ///< (N) s, increasing, N >= 2
  Eigen::MatrixXd q;     ///< (N x n) rad or m
  Eigen::MatrixXd dq;    ///< (N x n) rad/s or m/s
  Eigen::MatrixXd ddq;   ///< (N x n) rad/s^2 or m/s^2

  [[nodiscard]] Eigen::Index samples() const { return time.size(); }
  [[nodiscard]] int joints() const { return static_cast<int>(q.cols()); }

  /// @throws std::invalid_argument  if the sizes differ, there are fewer than two samples or no
  ///         joint, time does not increase, or a value is not finite
  void validate() const;
};

/// Reads a trajectory (.csv, .csv.gz): a header `time,q1..qn[,qd1..qdn][,qdd1..qddn]` and one row a
/// sample, with the repairs of recordings (docs/reference/recordings.md). A recording is accepted
/// too; what else it has is ignored.
///
/// Velocities that are absent are the derivative of a cubic spline through the positions, and
/// absent accelerations that of a spline through the velocities (differentiate_spline()).
/// @param repairs  what was repaired is appended, if not null
/// @throws RecordingError  positioned; also if time leaves a gap: a robot cannot follow that
Trajectory read_trajectory(const std::string& path, std::vector<Notice>* repairs = nullptr);
/// The same of what else makes samples: a log and its map.
Trajectory read_trajectory(const RecordingInput& input, std::vector<Notice>* repairs = nullptr);

/// Writes time, q, qd, qdd. The file appears at once when it is complete; a name that ends in
/// ".gz" is packed. Reading gives the identical trajectory.
/// @throws std::invalid_argument  of Trajectory::validate()
/// @throws RecordingError         if the file cannot be written, with the system's reason
void write_trajectory(const Trajectory& trajectory, const std::string& path);

/// The motion at any time, for a control loop: no allocation, the time of a binary search.
///
/// Between samples the quintic polynomial that has q, dq, ddq of both (Hermite interpolation), so
/// that all three are continuous and belong together. Before the first and after the last sample
/// the robot is asked to stand there: dq = ddq = 0.
/// @param trajectory  as validate() wants it
/// @param q dq ddq    n values each, written; null: not wanted
void motion_at(const Trajectory& trajectory, double time, double* q, double* dq,
               double* ddq) noexcept;

}  // namespace dyngen::runtime
