// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "runtime/ripple/order_spectrum.h"

namespace dyngen::runtime {

/// Waves of an order in both directions behind the filter: cosine and sine, forward and backward.
/// Samples that do not count for the order are 0.
struct WaveColumns {
  Eigen::MatrixXd columns;  ///< (N x 2 or 4)
  bool forward = false, backward = false;
};
WaveColumns wave_columns(const WhiteResidual& white, double order, double most);

/// The torque that a position error of this order makes, for an inertia of one: the same columns
/// with -(n^2 dq^2 cos(nq) + n ddq sin(nq)) and -(n^2 dq^2 sin(nq) - n ddq cos(nq)).
Eigen::MatrixXd position_columns(const WhiteResidual& white, double order, double most);

/// What is left of `e` beside columns.
Eigen::VectorXd left_beside(const Eigen::MatrixXd& columns, const Eigen::VectorXd& e);

/// What explains an order as well as the order itself does.
struct OrderRival {
  RippleKind kind = RippleKind::kFrequency;
  double value = 0;      ///< Hz, or an order
  Eigen::VectorXd left;  ///< (N) what it leaves
};

/// @param e     white, with the order in it
/// @param test  of the order
/// @return      none: neither a fixed frequency nor another order explains it
std::optional<OrderRival> rival_of(const WhiteResidual& white, const Eigen::VectorXd& e,
                                   double order, const OrderTest& test, const RippleRules& rules);

/// Torque and position error beside one another.
struct PositionTest {
  double torque_beside = 1;    ///< probability of what the torque adds to the position error
  double position_beside = 1;  ///< and the other way round
};
PositionTest position_test(const WhiteResidual& white, const Eigen::VectorXd& e, double order,
                           const OrderTest& test, const RippleRules& rules);

}  // namespace dyngen::runtime
