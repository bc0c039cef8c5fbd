// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace dyngen::runtime {

/// Which orders of the joint's angle are looked at.
struct OrderRange {
  double least = 0, most = 0;  ///< periods per turn
  double resolution = 0;       ///< turns of travel under one: orders closer are one
  [[nodiscard]] bool empty() const { return !(most > least); }
};

/// An order that stands out of its neighbours.
struct GearLine {
  double order = 0;
  double ratio = 0;   ///< of its power to the mean of its neighbours
  double chance = 1;  ///< of such a ratio at any of the orders
  double power = 0;   ///< square of the weighted sum of the residual times exp(i order q)
};

/// The line of `residual` over the angle that stands out most of its neighbours, by Fisher's F of 2
/// degrees to 2 of each neighbour; the chance is multiplied by the number of independent orders.
/// Neighbours are one resolution apart, and none is within 1.5 of the line.
/// @param q          (N) rad   @param neighbours  on both sides together
/// @param known      orders that were found: what is closer than 1.5 resolutions is a part of them
/// @return           none: too few orders
std::optional<GearLine> strongest_line(const Eigen::VectorXd& q, const Eigen::VectorXd& residual,
                                       const OrderRange& range, int neighbours,
                                       const std::vector<double>& known = {});

/// Orders that samples and travel can show: from `cycles` periods in the travel, to a quarter of a
/// period per sample at the usual speed.
OrderRange orders_seen(const Eigen::VectorXd& q, const Eigen::VectorXd& dq, double sample_time,
                       double cycles);

}  // namespace dyngen::runtime
