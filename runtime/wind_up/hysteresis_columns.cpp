// SPDX-License-Identifier: MIT
#include "runtime/wind_up/hysteresis_columns.h"

#include <cmath>

namespace dyngen::runtime {

using Eigen::Index;

Eigen::VectorXd hysteresis_column(const Eigen::VectorXd& driver,
                                  const std::vector<Index>& run_starts, double reach) {
  Eigen::VectorXd column(driver.size());
  for (std::size_t run = 0; run < run_starts.size(); ++run) {
    const Index first = run_starts[run];
    const Index end = run + 1 < run_starts.size() ? run_starts[run + 1] : driver.size();
    double z = 0;
    for (Index k = first; k < end && z == 0; ++k) {
      if (std::abs(driver[k] - driver[first]) > reach) z = driver[k] > driver[first] ? 1 : -1;
    }
    for (Index k = first; k < end; ++k) {
      const double step = k > first ? driver[k] - driver[k - 1] : 0;
      const double sign = step >= 0 ? 1 : -1;
      z = sign + (z - sign) * std::exp(-std::abs(step) / reach);  // exact along one direction
      column[k] = z;
    }
  }
  return column;
}

}  // namespace dyngen::runtime
