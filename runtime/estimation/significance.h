// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/estimation/least_squares.h"

namespace dyngen::runtime {

/// Experimental torque sensitivities |Y_i' tau| / ||tau||: to first order what one unit of a
/// parameter does to the norm of the torque: (nb), N m per unit of the parameter.
/// Source: the thesis, 4.3, 2.
Eigen::VectorXd torque_sensitivity(const TorqueFactor& factor,
                                   const Eigen::VectorXd& joint_weights);

/// 1 / sensitivity, for LeastSquaresOptions::scale. Where a column is all but orthogonal to the
/// torque, its sensitivity says nothing, and a hundredth of its norm is taken.
Eigen::VectorXd sensitivity_scale(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights);

/// What a significance analysis does to the problem: a column of the thesis's Table 7.2.
struct Significance {
  std::vector<int> kept;        ///< ascending
  std::vector<int> removed;     ///< in the order of removal
  double condition_before = 0;  ///< as the analysis scales columns
  double condition_after = 0;
  Estimate estimate;  ///< over all parameters; removed ones are 0
};

/// (a) Removes columns whose sensitivity, unscaled, is below `least` of the largest one.
/// Source: the thesis, 4.3, 3 (a).
Significance remove_insensitive(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights,
                                double least);

/// (b) Removes near dependencies: the entry of largest size in the right singular vector of the
/// smallest singular value, columns scaled, until the condition is at most `most`.
/// Source: the thesis, 4.3, 3 (b); Schroer's scaling.
Significance remove_dependent(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights,
                              double most);

/// (c) Leaves out the components along the weakest directions; no parameter is removed.
/// @param directions  how many; negative: those at the end whose component is not significant,
///                    less than 2 standard deviations of white noise
/// Source: the thesis, 4.3, 3 (c).
Significance drop_weakest(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights,
                          int directions);

/// Essential parameters: removes the parameter with the largest relative standard deviation until
/// no deviation is above `ratio` times the smallest one, or the residual would grow by more than
/// `growth`.
/// Source: Pham and Gautier, "Essential parameters of robots", CDC 1991.
Significance essential_parameters(const TorqueFactor& factor, const Eigen::VectorXd& joint_weights,
                                  double ratio = 10, double growth = 0.02);

}  // namespace dyngen::runtime
