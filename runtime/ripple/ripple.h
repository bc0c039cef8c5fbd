// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/rules/ripple_rules.h"

namespace dyngen::runtime {

/// What one joint shows. Runs follow one another.
struct RippleData {
  double sample_time = 0;      ///< s
  Eigen::VectorXd q, dq, ddq;  ///< (N)
  Eigen::VectorXd residual;    ///< (N) N m, unfiltered torque less the slow model
  std::vector<Eigen::Index> run_starts = {0};
  std::vector<double> stated{};  ///< orders that the machine should have: tested first
  double gear_ratio = 0;         ///< turns of the motor for one of the joint; 0: not known
};

/// A number with its 95 % interval.
struct RippleNumber {
  double value = 0, low = 0, high = 0;
};

/// Amplitude and phase in some direction: amplitude*cos(order*q - phase).
struct RippleWave {
  bool known = false;      ///< the joint moves in that direction
  RippleNumber amplitude;  ///< N m
  RippleNumber phase;      ///< rad
};

/// What an order is taken for.
enum class RippleKind {
  kTorque,     ///< a torque that depends on the position
  kPosition,   ///< a position error: of the gear or the encoder
  kFrequency,  ///< a line or resonance of fixed frequency explains it
  kImage       ///< another order, above Nyquist, explains it as well
};

/// An order of the joint's angle in its torque.
struct RippleLine {
  RippleKind kind = RippleKind::kTorque;
  RippleNumber order;   ///< periods per turn of the joint
  double stated = 0;    ///< the stated order that it may be; 0: none
  double of_motor = 0;  ///< periods per turn of the motor; 0: gear ratio not known
  double chance = 1;    ///< of noise as strong, at any of the orders that were looked at
  double lambda = 0;    ///< noncentrality: chi-square that the noise does not explain
  RippleWave both, forward, backward;
  bool differs = false;   ///< the two directions differ
  bool open = false;      ///< position error and torque are not told apart
  bool by_speed = false;  ///< a position error beside the torque: the amplitude grows with speed
  double least_hz = 0, most_hz = 0;  ///< frequencies at which it was seen: 5 % to 95 % of samples
  double rival = 0;                  ///< Hz of kFrequency, order of kImage; else 0
};

/// What is known of the ripple of one joint.
struct RippleResult {
  int joint = -1;  ///< from 0
  bool judged = false;
  std::string why_not;                ///< a sentence where it is not judged
  Eigen::Index moving = 0;            ///< samples in motion; 0: the joint stands
  std::vector<RippleLine> lines;      ///< kTorque and kPosition, strongest first
  std::vector<RippleLine> ruled_out;  ///< kFrequency and kImage
  bool cut_off = false;               ///< more orders stand out than are sought
  double below = 0;                   ///< N m: a ripple of this amplitude would have been found
  double least_order = 0, most_order = 0, resolution = 0;  ///< that were looked at
  double noise = 0;  ///< N m, standard deviation of the white part of the noise
  /// For charts: (M) orders, amplitudes that the torque shows there, and the amplitude of noise
  /// above which an order is found.
  Eigen::VectorXd shown_order, shown_amplitude, shown_noise;
};

/// Orders of the joint's angle in its torque, of any height, over varying speed.
/// docs/explanation/ripple.md has the method, its tests and its limits.
/// @throws std::invalid_argument  if sizes differ
RippleResult analyse_ripple(const RippleData& data, const RippleRules& rules = {});

}  // namespace dyngen::runtime
