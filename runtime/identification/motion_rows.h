// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/rows.h"
#include "runtime/identification/motion_source.h"
#include "runtime/model/linear_model.h"
#include "runtime/signals/decimation.h"

namespace dyngen::runtime {

struct RowOptions {
  /// Samples for one equation, behind the parallel filter; 0: so that the new Nyquist frequency is
  /// `band` times the cut-off; 1: no parallel filter, every sample is an equation.
  Eigen::Index decimation = 0;
  /// rad/s or m/s: a joint that moves slower has no equation, since there friction is not Coulomb's
  /// and its sign is not known; 0: a joint that stands has equations too; negative: a hundredth of
  /// the joint's largest speed, and at least three standard deviations of the velocity's noise.
  double still_speed = -1;
  double band = 1.25;  ///< > 0; the joint state is damped near 1 and above, and equations with it
  Eigen::Index multiple = 1;  ///< a decimation that is chosen and larger is a multiple of this
  FilterShape filter = {};    ///< the parallel filter
  double row_time = 0;        ///< s, between equations: a decimation that is chosen gives no less
};

/// Part of a joint's largest speed below which it stands, unless a speed is given.
inline constexpr double kStandstillPart = 0.01;

/// How the equations of a recording are made.
struct RowPlan {
  Eigen::Index decimation = 1;
  FilterShape filter = {};  ///< the parallel filter
  double row_time = 0;      ///< s, between equations of a run
  /// (n) rad/s or m/s: joints that are slower have no equations. 0 or negative: all have; infinite:
  /// none has, since its torque was not measured.
  Eigen::VectorXd still_speed;
  Eigen::VectorXd acceleration_noise;  ///< (n) standard deviation behind all filters
};
RowPlan plan_rows(const MotionSource& source, const RowOptions& options);

/// The equations tau = Y beta of a recording: regressor at the joint state, and one parallel filter
/// with decimation over both sides.
/// @param model  must outlive the source; has as many joints as the recording
/// @throws std::invalid_argument  if it has not
/// Source: Gautier, "Dynamic identification of robots with power model", ICRA 1997 (filtering and
/// decimation of both sides).
RowSource rows_of(const LinearModel& model, const MotionSource& source, const RowOptions& options);
/// The same by a plan of one's own.
RowSource planned_rows(const LinearModel& model, const MotionSource& source, const RowPlan& plan);

/// All rows of several sources, one after the other.
RowSource joined(std::vector<RowSource> sources);

/// What acceleration noise adds to the regressor, as equations with torque 0: R'R is the expected
/// sum of dH'dH over a recording.
/// @param postures   (N x n) spread evenly over the recording       @param equations  a joint has
/// Source: the thesis, (5.3).
TorqueFactor regressor_noise(const LinearModel& model, const Eigen::MatrixXd& postures,
                             const RowPlan& plan, double equations);

}  // namespace dyngen::runtime
