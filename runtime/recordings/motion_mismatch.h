// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::runtime {

/// Two pieces of one motion repeat each other if positions differ by no more than 1 % (rms) of the
/// motion's standard deviation times sqrt(2), or by what noise explains. Mismatch: mean over
/// samples of (x' - x)^2 / 2 in units of the variance, weighted by the noise, of the joint where it
/// is largest. 0: repeats; kJustRepeats: just so; with no noise, 1: unrelated.
inline constexpr double kJustRepeats = 1e-4;

/// Samples from which a motion can be compared.
inline constexpr Eigen::Index kFewestSamples = 16;

/// A joint that moves, and the factor by which its positions enter the mismatch.
struct MovingJoint {
  Eigen::Index joint = 0;
  double weight = 1;  ///< kJustRepeats / (kJustRepeats + 4 noise^2), noise per standard deviation
  double scale = 1;   ///< root of the weight over the standard deviation, 1/rad or 1/m
};

/// Joints that move, not those that a controller holds while others do.
/// @param q  (N x n) rad or m
std::vector<MovingJoint> moving_joints(const Eigen::Ref<const Eigen::MatrixXd>& q);

/// A recording of a motion that another one has too.
struct SameMotion {
  double lag = 0;       ///< samples: the other's row k is the first one's row k + lag
  double mismatch = 1;  ///< as above; the motion is the same up to kJustRepeats
};

/// The lag at which two recordings with one sample time agree best, up to a quarter of the shorter
/// one either way.
/// @param first, other  (N x n) positions, rad or m
SameMotion compare_motions(const Eigen::Ref<const Eigen::MatrixXd>& first,
                           const Eigen::Ref<const Eigen::MatrixXd>& other);

}  // namespace dyngen::runtime
