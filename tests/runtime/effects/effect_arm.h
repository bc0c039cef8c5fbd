// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "runtime/effects/effect_law.h"
#include "runtime/effects/effect_recordings.h"

namespace dyngen::test {

/// An arm of two joints in a vertical plane, written down by hand: ZZ1R MX1R MY1 ZZ2 MX2 MY2 IA2,
/// then Fc, Fv and off of each joint.
runtime::LinearModel planar_arm();
/// Parameters of it: (13).
Eigen::VectorXd planar_arm_values();
/// d_gx, d_gy, payload_M of it (a mass in the second frame's origin), contact_fx, contact_fy and
/// contact_nz of each link, all by hand.
runtime::EffectRobot planar_arm_tangents();

/// A motion of both joints that is a sum of sines, derivatives exact.
/// @param phase  another motion for each
/// @param start  s, what time the first sample shows
runtime::Motion sines(double seconds, double sample_time, double phase = 0, double speed = 1,
                      double start = 0);

/// The motion as a recording's, without noise: one equation a sample.
runtime::MotionSource source_of(const runtime::Motion& motion);

/// Bounds and sizes of a hand-made law's parameter; expressions of effect files are functions here.
struct LawParameter {
  std::string name;
  runtime::EffectRole role = runtime::EffectRole::kLinear;
  double min, max, start, typical;
  bool logarithmic = false;
  int grid = 0;
};

/// A law without states, its derivatives by central differences.
/// @param torque  of variables and parameters
runtime::EffectLaw algebraic_law(
    const std::string& name, const std::vector<std::string>& variables,
    const std::vector<LawParameter>& parameters,
    std::function<double(const Eigen::VectorXd& v, const Eigen::VectorXd& p)> torque);

runtime::EffectLaw stribeck_law();           ///< (Fs - Fc) exp(-(qd/vs)^2) sign_qd; Fs >= Fc
runtime::EffectLaw load_friction_law();      ///< mu |tau_load| sign_qd
runtime::EffectLaw spring_law();             ///< k q
runtime::EffectLaw ripple_law();             ///< a cos(n q) + b sin(n q), n scanned in 5 .. 60
runtime::EffectLaw coulomb_asymmetry_law();  ///< a |sign_qd|
runtime::EffectLaw tilt_law();               ///< x d_gx + y d_gy, on all joints
runtime::EffectLaw payload_law();  ///< m payload_M between t1 and t2 (given), on all joints
/// A force in the arm's plane and a moment on a link between two times (scanned), on the joint of
/// the link and those before it.
runtime::EffectLaw contact_law();
/// k z with dz/dt = qd, |z| <= reach: an element that sticks and slips.
runtime::EffectLaw slip_law();
runtime::EffectLaw delay_law();  ///< of all joints
runtime::EffectLaw lag_law();    ///< of all joints

/// All parameters without a number.
runtime::EffectInstance unknown(const runtime::EffectLaw& law, int joint, int other = -1);
runtime::EffectInstance known(const runtime::EffectLaw& law, int joint,
                              const std::vector<double>& parameters);

/// The recordings with the torque of the arm and of effects, and noise of an autoregressive process
/// of order 1.
/// @param coefficient  of the noise, 0: white
std::vector<runtime::MotionSource> measured(const std::vector<runtime::Motion>& motions,
                                            const Eigen::VectorXd& beta,
                                            const std::vector<runtime::EffectInstance>& effects,
                                            double noise, double coefficient, unsigned seed);

}  // namespace dyngen::test
