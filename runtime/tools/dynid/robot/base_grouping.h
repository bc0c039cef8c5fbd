// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "gen/base_parameters/base_parameters.h"

namespace dyngen::runtime {

/// How base parameters are made of standard ones: beta = grouping * standard, (nb x 14 links).
Eigen::MatrixXd grouping_matrix(const SymbolicRobot& robot,
                                const std::vector<GroupedParameter>& parameters);

/// The base parameters that are left where the file's zeros tie some of them together: beta =
/// combination * beta(kept).
struct IndependentParameters {
  std::vector<std::size_t> kept;
  Eigen::MatrixXd combination;  ///< (nb x kept)
};

/// A base parameter whose standard parameters stand in others too, in the same ratio, is no unknown
/// of its own: of a link of which only YY is open, XXR2 = -YY2 and ZZR1 = YY2.
IndependentParameters independent_parameters(const Eigen::MatrixXd& grouping);

/// Columns of the grouping that carry the base parameters: a parameter's own place where it is one,
/// else chosen so that the system is well conditioned.
std::vector<Eigen::Index> choose_places(const Eigen::MatrixXd& grouping,
                                        const std::vector<GroupedParameter>& parameters);

}  // namespace dyngen::runtime
