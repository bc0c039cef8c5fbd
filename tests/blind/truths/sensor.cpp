// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "tests/blind/truths/parts.h"

namespace blind {
namespace {

/// A column as it was `late` seconds before, between samples by the cubic of Catmull and Rom.
VectorXd delayed(const VectorXd& column, double late, double rate) {
  const Index n = column.size();
  const auto value = [&](Index k) { return column[std::clamp<Index>(k, 0, n - 1)]; };
  VectorXd result(n);
  for (Index k = 0; k < n; ++k) {
    const double place = static_cast<double>(k) - late * rate;
    const Index low = static_cast<Index>(std::floor(place));
    const double u = place - static_cast<double>(low);
    const double a = value(low - 1), b = value(low), c = value(low + 1), d = value(low + 2);
    result[k] = b + u / 2 * (c - a + u * (2 * a - 5 * b + 4 * c - d + u * (3 * (b - c) + d - a)));
  }
  return result;
}

Truth time_delay(const Machine&, Index joint, Random) {
  Truth truth = truth_of("time_delay", joint, "the torque is recorded s late", false);
  truth.typical = 0.003;
  truth.most = 0.03;
  is_called(truth, "T");
  truth.log = [=](double size, int, Log& log) {
    log.recorded.col(joint) = delayed(log.recorded.col(joint), size, log.rate);
  };
  return truth;
}

Truth sensor_drift(const Machine& machine, Index joint, Random random, double duration) {
  Truth truth = truth_of("sensor_drift", joint, "s sqrt(t/T) more in the record", true);
  const double sign = random.sign();
  truth.typical = 0.2 * machine.coulomb[joint];
  truth.numbers = {{"sign", sign}, {"T", duration}};
  truth.log = [=](double size, int, Log& log) {
    for (Index k = 0; k < log.recorded.rows(); ++k) {
      const double t = static_cast<double>(k) / log.rate;
      log.recorded(k, joint) += sign * size * std::sqrt(t / duration);
    }
  };
  return truth;
}

Truth kinematic_ripple(const Machine&, Index joint, Random random) {
  const double order = std::round(random.decade(12, 50)), phase = random.between(0, 2 * kPi);
  Truth truth = truth_of("kinematic_ripple", joint,
                         "the encoder adds s (sin u + 0.3 sin(2 u + 1)), u = n q + phase", true);
  truth.typical = 3e-4;
  truth.most = 0.02;
  truth.numbers = {{"n", order}, {"phase", phase}};
  truth.log = [=](double size, int, Log& log) {
    for (Index k = 0; k < log.q.rows(); ++k) {
      double& q = log.q(k, joint);
      double& dq = log.dq(k, joint);
      double& ddq = log.ddq(k, joint);
      double e = 0, slope = 0, bend = 0;
      for (const auto& [times, size_of, shift] :
           {std::array{1.0, 1.0, 0.0}, std::array{2.0, 0.3, 1.0}}) {
        const double n = times * order, u = n * q + times * phase + shift;
        e += size_of * std::sin(u);
        slope += size_of * n * std::cos(u);
        bend -= size_of * n * n * std::sin(u);
      }
      ddq += size * (slope * ddq + bend * dq * dq);
      dq *= 1 + size * slope;
      q += size * e;
    }
  };
  return truth;
}

Truth encoder_offset(const Machine&, Index joint, Random random) {
  Truth truth = truth_of("encoder_offset", joint, "the encoder adds s", false);
  const double sign = random.sign();
  truth.typical = 0.02;
  truth.most = 0.4;
  truth.numbers = {{"sign", sign}};
  is_called(truth, "offset", -sign);
  truth.log = [=](double size, int, Log& log) { log.q.col(joint).array() += sign * size; };
  return truth;
}

/// Bending of a joint, by a hinge that does not move: MuJoCo's inverse dynamics of that tree.
Truth torque_crosstalk(const Machine& machine, Index joint, Random random) {
  Truth truth = truth_of("torque_crosstalk", joint,
                         "s of the moment about an axis across the joint, in the record", false);
  const double angle = random.between(0, 2 * kPi);
  truth.typical = 0.02;
  truth.most = 0.5;
  truth.numbers = {{"angle", angle}};
  truth.parameters = [angle](double size) {
    return std::map<std::string, double>{{"cx", size * std::cos(angle)},
                                         {"cy", size * std::sin(angle)},
                                         {"lx", 0},
                                         {"ly", 0},
                                         {"lz", 0}};
  };
  Tree probe = machine.tree;
  Link& own = probe.links[at(joint)];
  Link hinge = own;
  hinge.name = "probe";
  hinge.axis = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  hinge.position.setZero();
  hinge.turn.setIdentity();
  own.inertia = {};
  const Index place = insert_link(probe, static_cast<int>(joint), hinge, true);
  const auto engine = std::make_shared<Engine>(mujoco_engine(probe));
  truth.plant = [=](double size, int, Plant& plant) {
    const std::vector<Index> drive = plant.carried;
    change(plant.recorded, joint, [=](const Moment& m, double u) {
      const Index n = static_cast<Index>(drive.size());
      VectorXd q = VectorXd::Zero(n + 1), dq = q, ddq = q;
      for (Index j = 0; j < n; ++j) {
        const Index c = j < place ? j : j + 1;
        q[c] = m.x[drive[at(j)]], dq[c] = m.v[drive[at(j)]], ddq[c] = m.a[drive[at(j)]];
      }
      return u + size * engine->inverse(q, dq, ddq)[place];
    });
  };
  return truth;
}

}  // namespace

std::vector<Physics> sensor_physics(const Schedule& schedule) {
  return {{"time_delay", {}, time_delay},
          {"sensor_drift",
           {},
           [schedule](const Machine& machine, Index joint, Random random) {
             return sensor_drift(machine, joint, random, schedule.duration);
           }},
          {"kinematic_ripple", {}, kinematic_ripple},
          {"encoder_offset", {}, encoder_offset},
          {"torque_crosstalk", {}, torque_crosstalk}};
}

}  // namespace blind
