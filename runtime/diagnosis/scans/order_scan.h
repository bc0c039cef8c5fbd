// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/evidence/evidence_system.h"

namespace dyngen::runtime {

/// Torque that repeats with a joint's position, over all orders that the equations can carry.
struct OrderScan {
  std::vector<double> peaks;  ///< times per turn of the joint, the strongest first; two at most
  /// The same of torque that grows with the square of the speed, as that of a position error does.
  std::vector<double> error_peaks;
  Eigen::VectorXd surrogates;  ///< the largest chi-square reduction over all orders
  double highest = 0;          ///< order up to which was looked
};

/// Columns cos(n q), sin(n q), by themselves and times the square of the speed, of one joint for n
/// from 1 (two turns of the range at least) up to the order at which half of the samples lie beyond
/// the parallel filter; in steps of half of what the range of positions resolves.
OrderScan scan_orders(const EffectRecordings& data, const EvidenceSystem& system, int joint,
                      bool surrogates);

}  // namespace dyngen::runtime
