// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <complex>
#include <optional>
#include <vector>

#include "runtime/ripple/white_residual.h"

namespace dyngen::runtime {

/// What an order has of a white residual, forward and backward: sums S = sum h* e over its
/// filtered wave h, and G = sum |h|^2. The wave a*cos(n*q - phase) has a*exp(-i phase) = 2 S/G.
struct OrderSums {
  std::array<std::complex<double>, 2> sum{};
  std::array<double, 2> gain{};

  /// Of the noise's variance, if noise is all there is: 2 |S|^2/G is chi-square of 2 degrees.
  [[nodiscard]] double power(std::size_t side) const {
    return gain[side] > 0 ? std::norm(sum[side]) / gain[side] : 0;
  }
  /// Of one wave in both directions.
  [[nodiscard]] double common() const {
    const double whole = gain[0] + gain[1];
    return whole > 0 ? std::norm(sum[0] + sum[1]) / whole : 0;
  }
  /// Of a wave of its own in each.
  [[nodiscard]] double separate() const { return power(0) + power(1); }
  [[nodiscard]] int sides() const { return (gain[0] > 0 ? 1 : 0) + (gain[1] > 0 ? 1 : 0); }
};

/// How an order stands out of its neighbours.
struct OrderTest {
  double level = 1;       ///< mean power of the neighbours: the noise's variance
  double degrees = 0;     ///< of the level
  double log_tail = 0;    ///< logarithm of the probability of the better of both
  bool separate = false;  ///< waves of their own in each direction stand out more
};
OrderTest order_test(const OrderSums& sums, double level, double degrees);

/// The sums of one order, exactly.
/// @param most  periods per sample: samples that see more are left out
OrderSums order_sums(const WhiteResidual& white, const Eigen::VectorXd& e, double order,
                     double most);

/// Which orders can be looked at.
struct OrderReach {
  double least = 0, most = 0;  ///< periods per turn
  double resolution = 0;       ///< turns of travel under one
  double apart = 0;  ///< orders whose noise is independent, where the travel is not visited evenly
  [[nodiscard]] bool empty() const { return !(most > least); }
};
OrderReach order_reach(const WhiteResidual& white, const RippleRules& rules);

/// Orders at a fine grid. Each octave has the samples that its highest order sees below Nyquist.
class OrderSpectrum {
 public:
  OrderSpectrum(const WhiteResidual& white, const Eigen::VectorXd& e, const OrderReach& reach,
                const RippleRules& rules);
  /// The octave of one order alone.
  OrderSpectrum(const WhiteResidual& white, const Eigen::VectorXd& e, const OrderReach& reach,
                const RippleRules& rules, double order);

  /// The order that stands out most, but for those near `known`.
  struct Peak {
    double order = 0;
    OrderTest test;
  };
  [[nodiscard]] std::optional<Peak> strongest(const std::vector<double>& known) const;

  /// Mean power of the neighbours of an order, and its degrees of freedom; none: too few.
  [[nodiscard]] std::optional<OrderTest> level_at(double order) const;

  /// Independent orders, twice: those between are looked at too.
  [[nodiscard]] double tests() const;

  /// Largest value of f(sums, level) in `count` parts of the reach.
  struct Shown {
    Eigen::VectorXd order, amplitude, noise;
  };
  [[nodiscard]] Shown shown(Eigen::Index count, double log_tail) const;

 private:
  struct Band {
    double from = 0, to = 0, step = 0;
    std::vector<OrderSums> sums;  ///< of the order i*step
  };
  [[nodiscard]] Band band(const WhiteResidual& white, const Eigen::VectorXd& e, double from,
                          double to) const;
  [[nodiscard]] std::optional<OrderTest> level_in(const Band& band, Eigen::Index place) const;

  const OrderReach& reach_;
  const RippleRules& rules_;
  std::vector<Band> bands_;
};

/// Amplitude at which the better test has this logarithm of its probability.
double amplitude_at(const OrderSums& sums, double level, double degrees, double log_tail);

}  // namespace dyngen::runtime
