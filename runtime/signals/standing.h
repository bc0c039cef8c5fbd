// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace dyngen::runtime {

/// Whether no joint moves by more than the noise of its positions: the range of each column is at
/// most kMovesAbove standard deviations of its white noise, as the differences of orders 2 to 8
/// show it (the least of them: what moves smoothly has small differences of high order).
/// @param q  (N x n) positions of one run, uniformly sampled, N >= 3
bool stands(const Eigen::Ref<const Eigen::MatrixXd>& q);

/// Standard deviation of white noise of positions: the least that differences of an even order, 2
/// to 8, say.
double difference_noise(Eigen::VectorXd x);

/// Standard deviations of the noise: six steps of an encoder. White noise of a million samples
/// stays within ten.
inline constexpr double kMovesAbove = 20;

}  // namespace dyngen::runtime
