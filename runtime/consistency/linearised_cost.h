// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "runtime/consistency/consistency_cost.h"

/// The rows of which the searches in S and a are made.
namespace dyngen::runtime {

/// Linear least squares of one step: ||rows dx + residual||^2, dx as stacked() has it.
struct LinearisedCost {
  Eigen::MatrixXd rows;
  Eigen::VectorXd residual;
};

/// A x - b on top, `rows` rows in all, zeros below. The large rows first: so QR with pivots is
/// stable although rows differ much in size.
LinearisedCost linearise_data(const ConsistencyCost& cost, const ScaledParameters& at,
                              Eigen::Index rows);

/// Square roots of `factor` for diagonal elements and 2 factor for others times the ten upper
/// elements: its squared norm is factor ||matrix||^2.
Eigen::Matrix<double, 10, 1> cone_residual(double factor, const Eigen::Matrix4d& matrix);

/// Writes factor ||G^-1 dS G^-T + gradient||^2 of a link (from 0) as ten rows from `first` on.
void write_cone_rows(LinearisedCost& step, Eigen::Index first, int link, double factor,
                     const Eigen::Matrix4d& inverse, const Eigen::Matrix4d& gradient);

/// Writes w ||a - a0||^2 as rows from `first` on.
void write_actuator_rows(LinearisedCost& step, Eigen::Index first, const ConsistencyCost& cost,
                         const ScaledParameters& at);

/// from + t dx
ScaledParameters moved(const ScaledParameters& from, const Eigen::VectorXd& dx, double t);

}  // namespace dyngen::runtime
