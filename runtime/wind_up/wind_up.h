// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "runtime/rules/decision_rules.h"

namespace dyngen::runtime {

/// Products of columns with the derivatives of the load by the parameters of its model.
struct LoadProducts {
  Eigen::MatrixXd with_columns;  ///< (k x p) D'Y
  Eigen::MatrixXd own;           ///< (p x p) Y'Y
};

/// A joint with two encoders: what was measured on both sides of the gear. Runs follow one another.
struct WindUpData {
  double sample_time = 0;  ///< s
  /// Hz, below which the joint state and the load are known; 0: not known
  double bandwidth = 0;
  Eigen::VectorXd wind_up;  ///< (N) rad or m, q less ql as they were measured
  Eigen::VectorXd q, dq, ddq;
  /// (N) N m or N that the gear passes to the link: of the rigid model, without friction and rotor
  Eigen::VectorXd load;
  /// Of the load's model; empty: its numbers are exact. @param D  (N x k)
  std::function<LoadProducts(const Eigen::MatrixXd& D)> load_products;
  Eigen::MatrixXd load_covariance;  ///< (p x p) of the parameters
  /// The torque cannot tell the rotor from the link: its inertia is in `load`, and is estimated.
  bool rotor_open = false;
  bool revolute = true;
  double position_step = 0;  ///< rad or m, of the coarser encoder; 0: not known
  double gear_ratio = 0;     ///< turns of the motor for one of the joint; 0: not known
  std::vector<Eigen::Index> run_starts = {0};
};

/// A number with its 95 % interval.
struct WindUpNumber {
  double value = 0;
  double low = 0, high = 0;  ///< high may be infinite
  double chance = 1;         ///< P of a value as far from 0, if it is 0
  bool seen = false;         ///< it pays for itself
  double below = 0;          ///< where it is not seen: 95 % bound of its size
};

/// An order of the joint's angle in the wind-up.
struct GearErrorLine {
  double order = 0;     ///< periods per turn of the joint
  double of_motor = 0;  ///< periods per turn of the motor; 0: gear ratio not known
  WindUpNumber amplitude;
  double phase = 0;   ///< rad: amplitude*cos(order*q - phase)
  double chance = 1;  ///< of standing out of its neighbours so far, anywhere
};

/// What two encoders say of one joint.
struct WindUpResult {
  int joint = -1;  ///< from 0
  bool revolute = true;
  bool judged = false;
  std::string why_not;  ///< a sentence where it is not judged

  WindUpNumber delay;             ///< s by which ql is late
  WindUpNumber compliance;        ///< rad/(N m) or m/N, at small load
  WindUpNumber stiffness;         ///< its reciprocal; infinite ends where the compliance holds 0
  WindUpNumber hardening;         ///< coefficient of the load's third power, rad/(N m)^3
  WindUpNumber hysteresis;        ///< rad or m, between both directions
  std::string hysteresis_driver;  ///< "motion" or "load"
  double hysteresis_reach = 0;    ///< rad, m, N m or N that a reversal takes
  WindUpNumber backlash;          ///< rad or m, gap
  bool backlash_decided = false;  ///< the load changes its sign often enough
  WindUpNumber slow_error;        ///< rad or m, peak to peak over the travel
  WindUpNumber rotor;             ///< kg m^2 or kg at the joint, where it was open
  bool rotor_estimated = false;
  std::vector<GearErrorLine> lines;
  double lines_below =
      0;  ///< rad or m: a line of this amplitude would stand out; 0: not looked for
  double least_order = 0, most_order = 0;  ///< that were looked at

  int degrees = 0;            ///< of freedom of the intervals
  double load_explained = 0;  ///< R^2 of the load by the other columns: 1 decides nothing
  double load_own = 0;        ///< rms of what the others do not explain, N m or N
  double attenuation = 0;     ///< largest share by which errors of the load lower the compliance
  double model_share = 0;     ///< of the compliance's variance that comes from the load's model
  double residual = 0;        ///< rms of what is left, rad or m
  std::vector<std::string> remarks;

  /// For charts: (M) load and wind-up without delay, offset and gear error; and what is fitted.
  Eigen::VectorXd shown_load, shown_wind_up, shown_fit;
};

/// Time between the encoders, compliance, hardening, hysteresis, backlash and gear error, together
/// by least squares of the wind-up.
///
///     w = offset + d dq(t - d/2) + c load(t - d) - c IA ddq + slow(q) + what pays for itself
///
/// slow(q) has the Chebyshev polynomials of the travel up to a degree that is fixed beforehand: a
/// gear error that is as slow as that is never taken for elasticity.
/// docs/explanation/two_encoders.md has the method, its tests and its limits.
WindUpResult analyse_wind_up(const WindUpData& data, const WindUpRules& rules);

/// Sentences of a result; with the effect joint_elasticity of a robot file or a finding.
std::string wind_up_sentence(const WindUpResult& result);
/// "agrees with", "contradicts" or "cannot judge" a compliance from elsewhere.
std::string compared_compliance(const WindUpResult& result, double compliance, double deviation,
                                const std::string& where);

/// The same where no elasticity was found in the torque. @param smallest  that would have been
std::string compared_with_none(const WindUpResult& result, double smallest);

}  // namespace dyngen::runtime
