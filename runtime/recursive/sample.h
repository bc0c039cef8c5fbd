// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

/// What one sample is to every estimator of this room, and how it is looked at without allocation.
///
/// `const double* Y` is the regressor of tau = Y beta as generated code writes it: row-major, n
/// rows (joints) of nb values (parameters). `const double* tau` has n values, N m or N.
namespace dyngen::runtime {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RegressorMap = Eigen::Map<const RowMajorMatrix>;
using VectorMap = Eigen::Map<const Eigen::VectorXd>;

/// Whether `values` is not null and `count` values there are finite.
inline bool all_finite(const double* values, Eigen::Index count) noexcept {
  return values != nullptr && VectorMap(values, count).allFinite();
}

/// Whether a sample can be used at all: nothing is null, infinite or not a number.
inline bool usable_sample(const double* Y, const double* tau, Eigen::Index joints,
                          Eigen::Index parameters) noexcept {
  return all_finite(tau, joints) && all_finite(Y, joints * parameters);
}

}  // namespace dyngen::runtime
