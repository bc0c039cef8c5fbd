// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

namespace dyngen::test {

/// What a motion may use of each joint.
struct MotionLimits {
  Eigen::VectorXd centre;        ///< (n) rad or m
  Eigen::VectorXd reach;         ///< (n) to both sides of the centre
  Eigen::VectorXd speed;         ///< (n)
  Eigen::VectorXd acceleration;  ///< (n)
};

/// q_j(t) = centre_j + sum over harmonics k of a_jk sin(w_k t) + b_jk cos(w_k t), w_k = 2 pi f k: a
/// motion whose derivatives are known exactly.
/// Source: Swevers, Ganseman et al., "Optimal robot excitation and identification", 1997 (the form;
/// coefficients here are random, not optimal).
struct FourierMotion {
  Eigen::VectorXd centre;         ///< (n)
  std::vector<double> frequency;  ///< rad/s, of each term
  Eigen::MatrixXd sine, cosine;   ///< (n x terms) a and b

  struct State {
    Eigen::VectorXd q, dq, ddq;
  };
  [[nodiscard]] State at(double time) const;
};

/// Random coefficients, each joint as large as its limits let it.
/// @param base_hz    f      @param harmonics  the k
/// @param seconds    over which the limits are kept
FourierMotion random_motion(const MotionLimits& limits, double base_hz,
                            const std::vector<int>& harmonics, double seconds, unsigned seed);

}  // namespace dyngen::test
