// SPDX-License-Identifier: MIT
#include "tests/blind/real/added_torque.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/support/numeric_dynamics.h"

namespace blind {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kTurn = 2 * std::numbers::pi;

double sign(double v) { return static_cast<double>((v > 0) - (v < 0)); }

/// A joint's torque sample by sample. @param value  of a sample's number
MatrixXd on_joint(const RealMotion& motion, Index joint,
                  const std::function<double(Index k)>& value) {
  MatrixXd torque = MatrixXd::Zero(motion.samples(), motion.joints());
  for (Index k = 0; k < motion.samples(); ++k) torque(k, joint) = value(k);
  return torque;
}

/// What stands before the torque of each kind: its family, its form, its usual size.
AddedTorque named(const std::string& family, Index joint, double typical, const std::string& form) {
  AddedTorque added;
  added.family = family;
  added.form = form;
  added.joint = static_cast<int>(joint) + 1;
  added.typical = typical;
  return added;
}

/// A function of position and speed of one joint, in units of its size.
AddedTorque of_state(AddedTorque added, std::function<double(double q, double dq)> curve) {
  const Index joint = added.joint - 1;
  added.torque = [joint, curve = std::move(curve)](double size, const Ground& ground) {
    return on_joint(ground.motion, joint, [&](Index k) {
      return size * curve(ground.motion.q(k, joint), ground.motion.dq(k, joint));
    });
  };
  return added;
}

AddedTorque friction(const std::string& family, Index joint, const JointUse& use, Random random) {
  if (family == "stribeck") {
    const double vs = use.fast * random.decade(0.04, 0.1);
    AddedTorque added =
        named(family, joint, 0.5 * use.dry, "s sign(v) / (1 + (v/vs)^2), by a quotient");
    added.numbers = {{"vs", vs}};
    return of_state(added, [vs](double, double v) { return sign(v) / (1 + v * v / (vs * vs)); });
  }
  if (family == "nonlinear_viscous") {
    const double fast = use.fast;
    return of_state(
        named(family, joint, 0.2 * use.dry, "s sign(v) |v/v90|^2.5"),
        [fast](double, double v) { return sign(v) * std::pow(std::abs(v) / fast, 2.5); });
  }
  if (family == "position_friction") {
    const double middle = random.between(use.low, use.high), width = 0.15 * (use.high - use.low);
    AddedTorque added = named(family, joint, 0.5 * use.dry, "s sign(v) exp(-((q - q0)/w)^2)");
    added.numbers = {{"q0", middle}, {"w", width}};
    return of_state(added, [=](double q, double v) {
      return sign(v) * std::exp(-(q - middle) * (q - middle) / (width * width));
    });
  }
  if (family == "load_friction") {
    AddedTorque added =
        named(family, joint, 0.2 * use.dry / std::sqrt(use.largest), "s sqrt(|load|) sign(v)");
    added.torque = [joint](double size, const Ground& ground) {
      return on_joint(ground.motion, joint, [&](Index k) {
        return size * std::sqrt(std::abs(ground.load(k, joint))) * sign(ground.motion.dq(k, joint));
      });
    };
    return added;
  }
  // friction that builds up over the way since the last turn, as a quotient
  const double way = random.decade(0.004, 0.02) * (use.high - use.low);
  AddedTorque added =
      named(family, joint, use.dry, "-s sign(v) / (1 + x/w), x the way since a turn");
  added.numbers = {{"w", way}};
  added.torque = [joint, way](double size, const Ground& ground) {
    double gone = 0, before = 0;
    const RealMotion& m = ground.motion;
    return on_joint(m, joint, [&](Index k) {
      const double now = sign(m.dq(k, joint));
      if (now != before) gone = 0;
      if (k > 0) gone += std::abs(m.q(k, joint) - m.q(k - 1, joint));
      before = now;
      return -size * now / (1 + gone / way);
    });
  };
  return added;
}

AddedTorque drive(const std::string& family, Index joint, const JointUse& use, Random random,
                  double duration) {
  if (family == "torque_ripple") {
    const double order = std::round(random.decade(12, 40)), phase = random.between(0, kTurn);
    AddedTorque added =
        named(family, joint, 0.1 * use.dry, "s (exp(sin u) - 1.266), u = n q + phase");
    added.numbers = {{"n", order}, {"phase", phase}};
    constexpr double kMean = 1.2660658777520084;  // of exp(sin u)
    return of_state(
        added, [=](double q, double) { return std::exp(std::sin(order * q + phase)) - kMean; });
  }
  if (family == "torque_gain") {
    AddedTorque added = named(family, joint, 0.1, "the torque is recorded 1 + s times as large");
    added.torque = [joint](double size, const Ground& ground) {
      return on_joint(ground.motion, joint,
                      [&](Index k) { return size * ground.motion.tau(k, joint); });
    };
    return added;
  }
  if (family == "time_delay") {
    AddedTorque added = named(family, joint, 0.003, "the torque is recorded s late");
    added.torque = [joint](double size, const Ground& ground) {
      const RealMotion& m = ground.motion;
      Index low = 0;
      return on_joint(m, joint, [&](Index k) {
        const double at = std::max(m.t[k] - size, m.t[0]);
        while (low + 2 < m.samples() && m.t[low + 1] < at) ++low;
        const double u = std::clamp((at - m.t[low]) / (m.t[low + 1] - m.t[low]), 0.0, 1.0);
        return (1 - u) * m.tau(low, joint) + u * m.tau(low + 1, joint) - m.tau(k, joint);
      });
    };
    return added;
  }
  AddedTorque added = named(family, joint, 0.5 * use.dry, "s sqrt(t/T)");
  added.numbers = {{"T", duration}};
  added.torque = [=](double size, const Ground& ground) {
    return on_joint(ground.motion, joint,
                    [&](Index k) { return size * std::sqrt(ground.motion.t[k] / duration); });
  };
  return added;
}

AddedTorque spring(const std::string& family, Index joint, const JointUse& use, Random random) {
  const double reach = use.high - use.low;
  if (family == "cable") {
    const double end = random.chance(0.5) ? use.high : use.low, way = end == use.high ? 1 : -1;
    AddedTorque added = named(family, joint, 0.5 * use.dry, "s exp(6 (q - end)/range)");
    added.numbers = {{"end", end}};
    return of_state(added,
                    [=](double q, double) { return way * std::exp(6 * way * (q - end) / reach); });
  }
  const double rest = random.between(use.low, use.high);
  AddedTorque added = named(family, joint, use.dry, "s x |x|, x = (q - q0)/range");
  added.numbers = {{"q0", rest}};
  return of_state(added, [=](double q, double) {
    const double x = (q - rest) / reach;
    return x * std::abs(x);
  });
}

/// Something that begins, in one recording.
AddedTorque event(const std::string& family, const RealRobot& robot, Index joint,
                  const JointUse& use, std::size_t fitted, double duration, Random random) {
  const std::size_t run = random.below(fitted);
  const double on = random.between(0.2, 0.6) * duration, lasts = random.between(0.4, 0.9);
  if (family == "contact") {
    Vector3d push, where;
    for (double& each : push) each = random.normal();
    push.normalize();
    for (double& each : where) each = random.between(-0.2, 0.2);
    AddedTorque added = named(family, joint, use.dry / 0.1,
                              "a push of s N on the link, as a half sine of the time");
    added.numbers = {{"run", run}, {"t_on", on}, {"t_off", on + lasts}};
    added.torque = [=](double size, const Ground& ground) {
      const RealMotion& m = ground.motion;
      MatrixXd torque = MatrixXd::Zero(m.samples(), m.joints());
      for (Index k = 0; k < m.samples(); ++k) {
        if (ground.recording != run || m.t[k] < on || m.t[k] > on + lasts) continue;
        const double now = size * std::sin(kTurn / 2 * (m.t[k] - on) / lasts);
        torque.row(k) =
            now * torque_of_force(robot, m.q.row(k).transpose(), joint, where, push).transpose();
      }
      return torque;
    };
    return added;
  }
  AddedTorque added = named(family, joint, 0.3, "the last link carries s kg from t_on");
  added.joint = 0;
  Vector3d where;
  for (double& each : where) each = random.between(0.05, 0.15);
  added.numbers = {{"run", run}, {"t_on", on}};
  added.torque = [=](double size, const Ground& ground) {
    dyngen::test::NumericRobot load = robot.bodies;
    const double x = where.x(), y = where.y(), z = where.z();
    load.joints.back().inertial = {size * (y * y + z * z),
                                   -size * x * y,
                                   -size * x * z,
                                   size * (x * x + z * z),
                                   -size * y * z,
                                   size * (x * x + y * y),
                                   size * x,
                                   size * y,
                                   size * z,
                                   size};
    const RealMotion& m = ground.motion;
    MatrixXd torque = MatrixXd::Zero(m.samples(), m.joints());
    const auto row = [](const MatrixXd& values, Index k) {
      const VectorXd own = values.row(k).transpose();
      return std::vector<double>(own.begin(), own.end());
    };
    for (Index k = 0; k < m.samples(); ++k) {
      if (ground.recording != run || m.t[k] < on) continue;
      const auto own = dyngen::test::id_rigid(load, row(m.q, k), row(m.dq, k), row(m.ddq, k));
      for (Index j = 0; j < m.joints(); ++j) torque(k, j) = own[static_cast<std::size_t>(j)];
    }
    return torque;
  };
  return added;
}

AddedTorque coupling(Index joint, Index joints, const JointUse& use) {
  const Index other = joint + 1 < joints ? joint + 1 : joint - 1;
  AddedTorque added = named("joint_coupling", joint, 0.2 * use.dry,
                            "both joints rub s tanh(w/w0), w the sum of their speeds");
  added.other = static_cast<int>(other) + 1;
  const double soft = 0.05 * use.fast;
  added.torque = [=](double size, const Ground& ground) {
    const RealMotion& m = ground.motion;
    MatrixXd torque = MatrixXd::Zero(m.samples(), m.joints());
    for (Index k = 0; k < m.samples(); ++k) {
      torque(k, joint) = torque(k, other) =
          size * std::tanh((m.dq(k, joint) + m.dq(k, other)) / soft);
    }
    return torque;
  };
  return added;
}

}  // namespace

AddedTorque draw_torque(const std::string& family, const RealRobot& robot,
                        const std::vector<JointUse>& uses, Index joint, std::size_t fitted,
                        double duration, Random random) {
  const JointUse& use = uses.at(static_cast<std::size_t>(joint));
  const auto is = [&](std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [&](const char* n) { return family == n; });
  };
  if (is({"stribeck", "nonlinear_viscous", "position_friction", "load_friction", "presliding"})) {
    return friction(family, joint, use, random);
  }
  if (is({"torque_ripple", "torque_gain", "time_delay", "sensor_drift"})) {
    return drive(family, joint, use, random, duration);
  }
  if (is({"cable", "gravity_spring"})) return spring(family, joint, use, random);
  if (is({"contact", "payload_change"})) {
    return event(family, robot, joint, use, fitted, duration, random);
  }
  if (family == "joint_coupling") return coupling(joint, static_cast<Index>(uses.size()), use);
  throw std::invalid_argument("draw_torque(): there is no family '" + family + "'");
}

}  // namespace blind
