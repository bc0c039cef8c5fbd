// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace dyngen::test {

enum class FrictionKind { kAsymmetric, kStribeck, kCubic, kPresliding };

/// A friction curve beside Coulomb's and the viscous one.
struct FrictionTerm {
  FrictionKind kind = FrictionKind::kAsymmetric;
  /// Of a Stribeck curve the speed, rad/s or m/s, at which it has fallen; of pre-sliding the way,
  /// rad or m, over which it builds up. Of others unused.
  double shape = 0;
};

/// As findings name it.
std::string family_of(const FrictionTerm& term);

/// Torque of size 1 at consecutive samples of one run.
/// |v|; sign(v) exp(-(v/vs)^2); v^3; z - sign(v), where dz/dt = (v - |v| z)/s from 0.
/// @param dq  (N)      @param sample_time  s
Eigen::VectorXd friction_column(const FrictionTerm& term, const Eigen::VectorXd& dq,
                                double sample_time);

/// Terms of every rung: none; asymmetric; and Stribeck's curve at several speeds; and either the
/// cubic term or pre-sliding over several ways besides. What a rung is called is its last term.
/// @param fast     rad/s or m/s, what 90 % of the samples are slower than
/// @param reach    rad or m, between the extreme positions
std::vector<std::vector<FrictionTerm>> friction_ladder(double fast, double reach);

/// The rung that, fitted to some equations, leaves least of others; of equal ones the first.
/// @param fitted, checked  columns of each rung, (equations x terms)
/// @param left, checked_left  what the base model leaves
std::size_t best_rung(const std::vector<Eigen::MatrixXd>& fitted, const Eigen::VectorXd& left,
                      const std::vector<Eigen::MatrixXd>& checked,
                      const Eigen::VectorXd& checked_left);

}  // namespace dyngen::test
