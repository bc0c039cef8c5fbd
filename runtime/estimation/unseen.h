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

/// Names what an estimate does not see.
/// @param model  its regressor is evaluated at motions of single joints, then of pairs, around the
/// middle of what was recorded, until one shows the combination
std::vector<UnseenCombination> name_unseen(const Estimate& estimate, const LinearModel& model,
                                           const MotionExtent& extent);

}  // namespace dyngen::runtime
