// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "runtime/estimation/noise_model.h"
#include "runtime/estimation/torque_factor.h"
#include "runtime/estimation/unseen.h"
#include "runtime/identification/motion_rows.h"

namespace dyngen::runtime {

/// All that linear estimators need of any number of recordings of one robot; of constant size.
struct RecordingSummary {
  TorqueFactor equations;
  NoiseFactor noise;
  TorqueFactor regressor_noise;
  MotionExtent extent;
  double row_time = 0;  ///< s between instants; the mean where recordings differ
  double lowest_cutoff = 0, highest_cutoff = 0;  ///< Hz
  std::int64_t recordings = 0;

  /// Instants at which there may be equations: some joints may rest at any of them.
  [[nodiscard]] double instants() const { return regressor_noise.samples(); }
  [[nodiscard]] double seconds() const { return row_time * instants(); }
};

/// A summary of nothing, of a robot with these columns.
RecordingSummary empty_summary(const std::vector<std::vector<int>>& columns, int parameters);

/// Adds other recordings. Associative and commutative but for rounding.
void merge(RecordingSummary& summary, const RecordingSummary& other);

/// All but the noise, in one pass over the recording.
RecordingSummary summarise_without_noise(const LinearModel& model, const MotionSource& source,
                                         const RowOptions& options);

/// Goes through a recording: once for its equations, and twice for its noise, at the fit to this
/// recording alone (or at `beta`, if it is not empty).
RecordingSummary summarise(const LinearModel& model, const MotionSource& source,
                           const RowOptions& options, const Eigen::VectorXd& beta = {});

/// The noise at a given estimate, of several recordings.
NoiseFactor noise_at(const Estimate& estimate, const TorqueFactor& equations,
                     const RowSource& rows);

/// Summaries of one type of robot, apart by the name of the robot (empty: not named).
struct RobotSummaries {
  std::string model;                    ///< name of the robot type
  std::vector<std::string> joints;      ///< names
  std::vector<std::string> parameters;  ///< names of the base parameters
  std::map<std::string, RecordingSummary> robots;
};

RobotSummaries empty_summaries(const LinearModel& model);

/// Adds another file's; robots of the same name become one.
/// @throws std::invalid_argument  if they are of another model; says in what they differ
void merge(RobotSummaries& all, const RobotSummaries& other);

/// All robots as one.
RecordingSummary pooled(const RobotSummaries& all);

}  // namespace dyngen::runtime
