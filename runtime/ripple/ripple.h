// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace dyngen::runtime {

/// Numbers that decide what is a ripple.
struct RippleOptions {
  /// Probability that noise shows any order as strong, below which an order is kept: 200 joints
  /// without ripple show none 19 times in 20, 1 - 0.95^(1/200).
  double chance = 2.5e-4;
  /// Probability of what is left of an order beside a rival explanation, below which the rival does
  /// not explain it: a single test.
  double beside = 0.01;
  /// Periods per turn from which orders are sought. Slower ones are in the band of the equations.
  double least_order = 5;
  /// Periods per turn up to which orders are sought: ten times the ratio of usual gears.
  double most_order = 2000;
  /// Periods per sample up to which a sample counts for an order: Nyquist's 0.5 less a tenth, where
  /// low-passes before sampling begin.
  double most_per_sample = 0.45;
  /// Of the speed that 90 % of the samples are below: slower samples are left out, since stiction
  /// is there. A twentieth of the travel is lost.
  double slowest = 0.05;
  /// Part of the samples that must count for an order.
  double least_samples = 0.1;
  /// Orders on each side that an order is compared with: F with 2 and 128 degrees of freedom where
  /// the joint moves both ways.
  int neighbours = 16;
  /// Distance in resolutions from which orders are neighbours: half of the main lobe is 1.
  double nearest = 1.5;
  /// Distance in resolutions below which an order is a part of a stronger one: its side lobes, and
  /// an amplitude that changes over the travel.
  double part_of_line = 3;
  /// Orders of a joint that are sought at most.
  int most_lines = 12;
  /// Samples in motion from which a joint is judged: 60 periods of 16 samples.
  Eigen::Index least_moving = 1000;
  /// Coefficients of the noise's autoregression at most: one resonance takes two.
  Eigen::Index most_coefficients = 12;
};

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
RippleResult analyse_ripple(const RippleData& data, const RippleOptions& options = {});

}  // namespace dyngen::runtime
