// SPDX-License-Identifier: MIT
// What noise leaves to be seen: equations in coordinates in which it is white.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "tests/blind/simulation/machine.h"
#include "tests/blind/simulation/noise.h"

namespace blind {

/// A recording, and what was added to it.
struct Recording {
  Log log;
  Eigen::MatrixXd torque_noise;   ///< (N x j) N m
  Eigen::MatrixXd encoder_error;  ///< (N x j) rad
  /// (N x j) N m that act beside the recorded torque; empty: none.
  Eigen::MatrixXd disturbance, compensation;
  std::size_t place = 0;  ///< among the recordings of its case
};

/// The torque that acts, (N x j): the recorded one without noise, and what acts beside it.
Eigen::MatrixXd known_torque(const Recording& recording);

/// Samples of each joint at which it rests: friction holds it with any torque there.
/// @param reach  s, before and after
std::vector<std::vector<Eigen::Index>> rests_of(const Log& log, double reach = 0);

/// Makes the equations 0 = 0 where a joint rests.
/// @param rows   (N j x k), in place
void leave_out_rest(const Log& log, Eigen::Ref<Eigen::MatrixXd> rows);

/// Gives a recording noise of another draw. @param place  of the recording
using DrawNoise = std::function<void(std::size_t place, std::size_t draw, Recording& recording)>;

/// The noise of the equations: of the torque, and what encoders add through the accelerations.
/// Mean spectra of recordings and, where noise can be drawn anew, of many draws of it: the noise
/// that three recordings happen to have is another one, at the lines of slow motion by half of its
/// power and more. Smoothed over near lines. Dividing by their root makes it white, of variance 1.
/// Recordings may differ in length: the lines are those of the longest.
class Whitener {
 public:
  /// @param draw  empty: of the noise that the recordings have
  explicit Whitener(const std::vector<Recording>& training, const DrawNoise& draw = {});
  /// One joint's values, (N). Symmetric in time.
  Eigen::VectorXd column(Eigen::Index joint, const Eigen::VectorXd& values) const;
  /// Undoes column() twice, nearly: lines that weigh less than `least` are taken as of that weight.
  Eigen::VectorXd coloured_twice(Eigen::Index joint, const Eigen::VectorXd& values,
                                 double least) const;
  /// Takes away what is faster.
  void stop_above(double hz, double rate);
  double stopped() const { return stopped_; }  ///< Hz; 0: nothing is
  Eigen::Index joints() const { return deviation_.cols(); }

 private:
  static void add(const Recording& recording, Eigen::MatrixXd& power);

  double stopped_ = 0;
  Eigen::MatrixXd deviation_;  // (lines x j) root of the spectrum, from 0 to half of the rate
};

/// Whitens the equations of one recording but for those where a joint rests, of which nothing is
/// known: what any torque there would change is taken out, so that gaps in coloured noise tell
/// nothing by their edges.
class RestWhitener {
 public:
  /// @param whitener  must outlive it
  /// @param reach     s, before and after a rest
  /// @param most_solved  unknown values of a joint that are solved for directly; 0: a usual number
  RestWhitener(const Whitener& whitener, const Log& log, double reach = 0,
               std::size_t most_solved = 0);
  /// @param rows  (N j x k), with any values where joints rest
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& rows) const;

 private:
  /// What unknown values at a joint's rests are, by what they would show there.
  Eigen::VectorXd unknown(Eigen::Index joint, const Eigen::VectorXd& shown) const;

  const Whitener& whitener_;
  Eigen::Index samples_;
  std::vector<std::vector<Eigen::Index>> rests_;     // of each joint
  std::vector<std::vector<Eigen::Index>> solved_;    // of these, whose unknown values are sought
  std::vector<Eigen::LLT<Eigen::MatrixXd>> weight_;  // of unknown values there, inverse covariance
  std::vector<double> least_;                        // added to that weight
  std::size_t most_solved_;
};

}  // namespace blind
