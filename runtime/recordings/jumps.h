// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// A position that is suddenly elsewhere and goes on from there.
struct Jump {
  Eigen::Index row = 0;  ///< within the run, the first one elsewhere
  double size = 0;       ///< beyond what the speeds before and after explain
  double steps = 0;      ///< the size, in usual steps near by; negative against the motion
};

/// Finds jumps of one run: from one sample to the next by at least 0.02, by what 1600 rad/s^2 do
/// (up to 0.3), by 10 times the second differences and 5 times the steps of the 8 samples on either
/// side, and by 10 times the resolution. A value that was held and then catches
/// up is no jump.
/// @param resolution  a small step of the column
std::vector<Jump> find_jumps(const Eigen::Ref<const Eigen::VectorXd>& time,
                             const Eigen::Ref<const Eigen::VectorXd>& position, double sample_time,
                             double resolution);

}  // namespace dyngen::runtime
