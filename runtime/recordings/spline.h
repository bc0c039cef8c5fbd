// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// Values between samples, by a cubic spline with not-a-knot ends (a cubic is reproduced exactly).
///
/// @param time    (N) s, increasing, N >= 2 (N = 2: a line, N = 3: a parabola)
/// @param values  (N x m), one column a signal
/// @param at      (K) s; outside of time the first or last piece is continued
/// @return        (K x m)
/// @throws        std::invalid_argument if the sizes differ or N < 2
Eigen::MatrixXd interpolate_spline(const Eigen::VectorXd& time,
                                   const Eigen::Ref<const Eigen::MatrixXd>& values,
                                   const Eigen::VectorXd& at);

/// The first derivative of that spline at its own samples. On an even grid its error is of the
/// fourth order in the step inside, of the third at the ends.
///
/// @return  (N x m), units of values per second
/// @throws  std::invalid_argument if the sizes differ or N < 2
Eigen::MatrixXd differentiate_spline(const Eigen::VectorXd& time,
                                     const Eigen::Ref<const Eigen::MatrixXd>& values);

/// interpolate_spline() along straight lines: for noisy signals, which a spline would amplify.
Eigen::MatrixXd interpolate_linear(const Eigen::VectorXd& time,
                                   const Eigen::Ref<const Eigen::MatrixXd>& values,
                                   const Eigen::VectorXd& at);

}  // namespace dyngen::runtime
