// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "runtime/estimation/least_squares.h"
#include "runtime/model/linear_model.h"

namespace dyngen::runtime {

/// How a joint moved while it was recorded.
struct MotionExtent {
  Eigen::VectorXd lowest, highest;  ///< (n) positions, rad or m
  Eigen::VectorXd speed;            ///< (n) rms, rad/s or m/s
  Eigen::VectorXd acceleration;     ///< (n) rms
  double samples = 0;

  /// Takes in further samples, (N x n) each.
  void add(const Eigen::MatrixXd& q, const Eigen::MatrixXd& dq, const Eigen::MatrixXd& ddq);
  void merge(const MotionExtent& other);
};

/// A combination of parameters that can change without any change of torque on the recordings.
struct UnseenCombination {
  std::vector<std::pair<int, double>> terms;  ///< parameter and factor, own units; largest first
  std::string text;                           ///< "MX5 + 0.35 ZZR6"
  std::string advice;                         ///< the motion that would show it, in a sentence
};

/// A sum of parameters that the recordings show where they show none of them alone.
struct SeenCombination {
  std::vector<std::pair<int, double>> terms;  ///< parameter and factor, own units; the first is 1
  std::string text;                           ///< "ZZR2 + ZZR4 + 0.42 MYR4"
  std::string unit;                           ///< of the first parameter
  double value = 0;
  double stddev = 0;  ///< NaN: the covariance is not known
};

/// The sums that an estimate with unseen combinations does see, but for parameters that it sees
/// alone, in the order of the model: as few terms as elimination leaves. Terms of less than a
/// thousandth of the torque of the largest are left out: a posture that is known to 1e-3 rad does
/// not show them.
/// @param beta        (nb) @param covariance  (nb x nb) or empty: of the fit that is told
std::vector<SeenCombination> name_seen(const Estimate& estimate, const LinearModel& model,
                                       const Eigen::VectorXd& beta,
                                       const Eigen::MatrixXd& covariance);

/// Names what an estimate does not see.
/// @param model  its regressor is evaluated at motions of single joints, then of pairs, around the
/// middle of what was recorded, until one shows the combination
std::vector<UnseenCombination> name_unseen(const Estimate& estimate, const LinearModel& model,
                                           const MotionExtent& extent);

}  // namespace dyngen::runtime
