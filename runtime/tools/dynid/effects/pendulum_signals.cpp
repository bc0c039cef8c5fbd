// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/pendulum_signals.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kSampleTime = 0.0005, kDuration = 10;
constexpr double kMass = 10, kPendulumLength = 0.5, kGravity = 9.81, kRotor = 0.5;
constexpr double kCoulomb = 4, kViscous = 3;
constexpr double kInertia = kMass * kPendulumLength * kPendulumLength,
                 kMoment = kMass * kPendulumLength;

/// Two harmonics, so that reversals differ.
struct Swing {
  VectorXd q, qd, qdd, jerk, snap;
};
Swing swing(const VectorXd& t, double phase) {
  const double w = 2 * std::numbers::pi / kDuration;
  Swing motion;
  for (VectorXd* part : {&motion.q, &motion.qd, &motion.qdd, &motion.jerk, &motion.snap}) {
    part->setZero(t.size());
  }
  for (const auto& [amplitude, order] : {std::pair{0.8, 2.0}, std::pair{0.25, 5.0}}) {
    const double v = order * w;
    for (Index k = 0; k < t.size(); ++k) {
      const double s = amplitude * std::sin(v * t[k] + phase * order);
      const double c = amplitude * std::cos(v * t[k] + phase * order);
      motion.q[k] += s;
      motion.qd[k] += v * c;
      motion.qdd[k] -= v * v * s;
      motion.jerk[k] -= v * v * v * c;
      motion.snap[k] += v * v * v * v * s;
    }
  }
  return motion;
}

VectorXd times() {
  return VectorXd::LinSpaced(static_cast<Index>(kDuration / kSampleTime) + 1, 0, kDuration);
}

/// J qdd + m l g sin q and its derivatives by time.
VectorXd load(const Swing& motion, int differences) {
  const double gravity = kMoment * kGravity;
  const Eigen::ArrayXd s = motion.q.array().sin(), c = motion.q.array().cos();
  const Eigen::ArrayXd qd = motion.qd, qdd = motion.qdd;
  if (differences == 0) return kInertia * qdd + gravity * s;
  if (differences == 1) return kInertia * motion.jerk.array() + gravity * c * qd;
  return kInertia * motion.snap.array() + gravity * (c * qdd - s * qd * qd);
}

/// tau_load with rotor, friction and offset.
VectorXd torque(const Swing& motion, int differences) {
  VectorXd result = load(motion, differences);
  if (differences == 0) {
    result.array() += kRotor * motion.qdd.array() + kCoulomb * motion.qd.array().sign() +
                      kViscous * motion.qd.array();
  } else if (differences == 1) {
    result.array() += kRotor * motion.jerk.array() + kViscous * motion.qdd.array();
  } else {
    result.array() += kRotor * motion.snap.array() + kViscous * motion.jerk.array();
  }
  return result;
}

VectorXd travelled(const VectorXd& q) {
  VectorXd distance = VectorXd::Zero(q.size());
  for (Index k = 1; k < q.size(); ++k) {
    const double step = q[k] - q[k - 1];
    const bool turned = k > 1 && step * (q[k - 1] - q[k - 2]) < 0;
    distance[k] = turned ? 0 : distance[k - 1] + std::abs(step);
  }
  return distance;
}

int differences_of(const std::string& name) {
  return name.ends_with("_acc") ? 2 : name.ends_with("_rate") ? 1 : 0;
}

}  // namespace

VectorXd pendulum_signal(const std::string& name) {
  VectorXd t = times();
  const bool partner = name.ends_with("_other");
  const std::string stem = partner ? name.substr(0, name.size() - 6) : name;
  const Swing motion = swing(t, partner ? 0.9 : 0);
  const auto q = motion.q.array();
  if (stem == "q") return motion.q;
  if (stem == "qd") return motion.qd;
  if (stem == "qdd") return motion.qdd;
  if (stem == "sign_qd") return motion.qd.array().sign();
  if (stem.starts_with("tau_load")) return load(motion, differences_of(stem));
  if (stem.starts_with("torque")) return torque(motion, differences_of(stem));
  if (stem == "Fc") return VectorXd::Constant(t.size(), kCoulomb);
  if (stem == "Fv") return VectorXd::Constant(t.size(), kViscous);
  if (stem == "Ia") return VectorXd::Constant(t.size(), kRotor);
  if (stem == "t") return t;
  if (stem == "temp") return 25 + 3 * t.array();
  if (stem == "distance") return travelled(motion.q);
  // the rigid model: the pendulum hangs along its x axis, gravity along x of frame 0
  if (stem == "d_q") return kMoment * kGravity * q.cos();
  if (stem == "d_qdd") return VectorXd::Constant(t.size(), kInertia);
  if (stem == "d_gx") return kMoment * q.sin();
  if (stem == "d_gy") return kMoment * q.cos();
  if (stem == "hidden_gx") return q.sin();
  if (stem == "hidden_gy") return q.cos();
  if (stem == "d_theta") return kMoment * kGravity * q.cos();
  if (stem == "d_alpha") return kMoment * kGravity * 0.1 * q.sin();
  if (stem == "d_d" || stem == "d_r") return kMass * kGravity * q.sin();
  if (stem == "payload_ZZ") return motion.qdd;
  if (stem == "payload_MX") return 2 * kPendulumLength * motion.qdd.array() + kGravity * q.sin();
  if (stem == "payload_MY") return kGravity * q.cos();
  if (stem == "payload_M") {  // its frame is at the tip
    return kPendulumLength * (kPendulumLength * motion.qdd.array() + kGravity * q.sin());
  }
  if (stem == "contact_fx") return -kPendulumLength * q.sin();
  if (stem == "contact_fy") return kPendulumLength * q.cos();
  if (stem == "contact_nz") return VectorXd::Ones(t.size());
  if (stem == "wrench_fx") {
    return -kMoment * motion.qd.array().square() - kMass * kGravity * q.cos();
  }
  if (stem == "wrench_fy") return kMoment * motion.qdd.array() + kMass * kGravity * q.sin();
  if (stem == "wrench_nx") return 0.1 * (kMoment * motion.qdd.array());
  if (stem == "wrench_ny") return 0.1 * (kMoment * motion.qd.array().square());
  return VectorXd::Zero(t.size());
}

PendulumRun pendulum_run(const EffectLaw& law) {
  PendulumRun run;
  run.sample_time = kSampleTime;
  run.time = times();
  run.distance = pendulum_signal("distance");
  run.variables.resize(run.time.size(), static_cast<Index>(law.variables.size()));
  for (std::size_t v = 0; v < law.variables.size(); ++v) {
    run.variables.col(static_cast<Index>(v)) = pendulum_signal(law.variables[v]);
  }
  return run;
}

EffectScales pendulum_scales() {
  const VectorXd qd = pendulum_signal("qd").cwiseAbs(), q = pendulum_signal("q");
  std::vector<double> speeds(qd.begin(), qd.end());
  std::sort(speeds.begin(), speeds.end());
  EffectScales scales;
  scales.Fc = kCoulomb;
  scales.Fv = kViscous;
  scales.Ia = kRotor;
  scales.v_max = speeds.back();
  scales.v90 = speeds[speeds.size() * 9 / 10];
  scales.q_range = q.maxCoeff() - q.minCoeff();
  scales.tau_max = pendulum_signal("torque").cwiseAbs().maxCoeff();
  scales.duration = kDuration;
  scales.position_step = 1e-5;
  scales.temp_range = 30;
  return scales;
}

}  // namespace dyngen::runtime
