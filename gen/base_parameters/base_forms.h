// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <vector>

#include "gen/base_parameters/base_parameters.h"
#include "gen/base_parameters/column.h"
#include "gen/base_parameters/dependencies.h"
#include "gen/base_parameters/echelon.h"
#include "gen/symbols/symbolic_robot.h"

namespace dyngen {

/// Base parameters as numbers: row i says how the i-th one is made of the standard parameters.
struct BaseForms {
  std::vector<Column> columns;
  Echelon forms;  ///< its pivots are the standard parameters that lend their names
};

/// All that inertia and rotors give: XX .. M of every link, link by link, then IA of moving joints.
std::vector<Column> inertial_columns(const SymbolicRobot& robot);

/// Random numbers for what the robot's geometry leaves unknown; the same for the same seed.
GiNaC::exmap random_lengths(const SymbolicRobot& robot, std::uint64_t seed);

/// Base parameters by the second route: coefficients of the joint accelerations and of gravity.
///
/// The torque's velocity terms follow from those of the accelerations (Christoffel symbols), so
/// what M(q) and g(q) show is all there is (thesis, Theorem 2, stated there for revolute joints).
/// M and g are sums of products of 1, cos q, sin q, cos^2 q, cos q sin q of the joints (1, q, q^2
/// of a prismatic one), which are independent functions: the coefficients of these products, linear
/// in the standard parameters, span what can be identified. No motion is drawn and no rank of
/// sampled torques is taken. See docs/explanation/base_parameters.md for how the products are kept
/// few.
///
/// @param lengths  a number for every unknown of the geometry
/// @param motions  kStanding: the coefficients of gravity alone
BaseForms coefficient_forms(const SymbolicRobot& robot, const GiNaC::exmap& lengths,
                            const std::vector<Column>& columns, Motions motions);

/// Base parameters by the third route: dependent columns of random regressor rows, scanned from
/// left to right (thesis 3.3.2), with nothing grouped beforehand.
///
/// @throws InternalError  if a dependency that the ranks show does not hold with 60 digits
BaseForms numeric_forms(const SymbolicRobot& robot, const GiNaC::exmap& lengths,
                        const std::vector<Column>& columns, Motions motions);

/// Base parameters by the first route, regroup(): its formulas as rows of numbers.
///
/// @param robot  what was regrouped: each of its chi a symbol of its own, or 0
BaseForms grouped_forms(const Regrouping& grouping, const SymbolicRobot& robot,
                        const GiNaC::exmap& lengths, const std::vector<Column>& columns);

/// True if one set can be computed from the other: as many, over the same columns, and together no
/// more.
bool same_space(const BaseForms& a, const BaseForms& b);

}  // namespace dyngen
