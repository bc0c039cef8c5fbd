// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/import/column_lookup.h"
#include "runtime/import/import_map.h"
#include "runtime/import/signal_units.h"

namespace dyngen::runtime {

/// From raw values of one signal to the joints.
///
/// With u the values in SI units where they are measured, and A the matrix whose row i is row i of
/// K where value i is a motor's and row i of the identity where it is a joint's:
///     positions, velocities, accelerations: x = A^-1 u + offset
///     torques: tau = A^T u + offset, since power is the same on both sides (u^T A dq = tau^T dq)
class JointTransform {
 public:
  /// @param units  of each column, from the log; the map's come first
  /// @throws ImportError  a unit is missing or wrong, or a number that it needs
  JointTransform(const ImportMap& map, const SignalMap& signal, ColumnQuantity quantity,
                 const std::vector<ColumnPlace>& columns, const ColumnLookup& lookup);

  /// @param raw  (n)   @param joints  (n), out; NaN where a value that it needs is NaN
  void apply(const double* raw, double* joints) const;

 protected:
  friend class DutyTransform;
  JointTransform() = default;
  void set_sides(const ImportMap& map, const SignalMap& signal, std::size_t joints, bool torque);
  void to_joints(double* joints) const;

  std::vector<UnitConversion> conversions_;
  std::vector<double> factors_, offsets_;
  Eigen::MatrixXd matrix_;  ///< A^-1, or A^T; 0 x 0: the identity
  mutable Eigen::VectorXd measured_;
};

/// Torque of a servo's duty cycle: see DutyTorque.
class DutyTransform {
 public:
  DutyTransform(const ImportMap& map, const SignalMap& signal, std::size_t joints);

  /// @param duty, voltage  (n) raw, V   @param dq  (n) of the joints   @param tau  (n), out
  void apply(const double* duty, const double* voltage, const double* dq, double* tau) const;

 private:
  DutyTorque law_;
  PerJoint constant_, sign_, gain_, efficiency_;
  std::size_t joints_;
  Eigen::MatrixXd speeds_;  ///< A; 0 x 0: the identity
  JointTransform torque_;
};

/// A of JointTransform; 0 x 0: the identity.
Eigen::MatrixXd side_matrix(const ImportMap& map, const SignalMap& signal, std::size_t joints);

}  // namespace dyngen::runtime
