// SPDX-License-Identifier: MIT
#include "tests/studies/foreign_torque.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace dyngen::test {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int kKinds = 7;

/// A damped pendulum that the joint shakes: x'' + 2 d w x' + w^2 x = ddq, by steps within which ddq
/// is constant.
VectorXd sloshing(const VectorXd& ddq, double sample_time, double hz, double damping) {
  const double w = 2 * std::numbers::pi * hz, decay = damping * w;
  const double wd = w * std::sqrt(1 - damping * damping);
  const double e = std::exp(-decay * sample_time), c = std::cos(wd * sample_time),
               s = std::sin(wd * sample_time);
  VectorXd result(ddq.size());
  double x = 0, v = 0;
  for (Index k = 0; k < ddq.size(); ++k) {
    result[k] = w * w * x;
    const double rest = ddq[k] / (w * w), from = x - rest;
    x = rest + e * (from * c + (v + decay * from) / wd * s);
    v = e * (v * c - (w * w * from + decay * v) / wd * s);
  }
  return result;
}

}  // namespace

ForeignTorque random_foreign_torque(int joints, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto any = [&](int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random);
  };
  ForeignTorque foreign;
  foreign.joint = any(joints);
  foreign.kind = any(kKinds);
  foreign.first = any(joints);
  foreign.second = (foreign.first + 1 + any(joints - 1)) % joints;
  const int j = foreign.first + 1, k = foreign.second + 1;
  switch (foreign.kind) {
    case 0:
      foreign.a = 3;
      foreign.b = 2;
      foreign.name = fmt::format("sin(3 q{} + 2 q{})", j, k);
      break;
    case 1:
      foreign.name = fmt::format("q{} qd{}^2", j, k);
      break;
    case 2:
      foreign.first = foreign.joint;
      foreign.a = 0.7 + 2 * uniform(random);
      foreign.b = 0.03 + 0.1 * uniform(random);
      foreign.name = fmt::format("sloshing at {:.2f} Hz, damping {:.2f}", foreign.a, foreign.b);
      break;
    case 3:
      foreign.first = (foreign.joint + 1 + any(joints - 1)) % joints;
      foreign.a = 1.5 + uniform(random);
      foreign.name = fmt::format("cos({:.2f} q{}) sign(qd{})", foreign.a, foreign.first + 1,
                                 foreign.joint + 1);
      break;
    case 4:
      foreign.first = foreign.joint;
      foreign.a = 2 + 2 * uniform(random);
      foreign.name = fmt::format("exp({:.2f} q{})", foreign.a, foreign.joint + 1);
      break;
    case 5:
      foreign.a = 0.8 + 3 * uniform(random);
      foreign.b = 2 * std::numbers::pi * uniform(random);
      foreign.name = fmt::format("sin(2 pi {:.3f} t + {:.2f})", foreign.a, foreign.b);
      break;
    case 6:
      foreign.name = fmt::format("tanh(qd{} qd{})", j, k);
      break;
  }
  foreign.name += fmt::format(" on joint {}", foreign.joint + 1);
  return foreign;
}

VectorXd foreign_torque(const ForeignTorque& foreign, const runtime::Recording& motion) {
  const ArrayXd q1 = motion.q.col(foreign.first), q2 = motion.q.col(foreign.second);
  const ArrayXd v1 = motion.dq.col(foreign.first), v2 = motion.dq.col(foreign.second);
  const ArrayXd v = motion.dq.col(foreign.joint);
  const auto torque = [&]() -> VectorXd {
    switch (foreign.kind) {
      case 0:
        return (foreign.a * q1 + foreign.b * q2).sin();
      case 1:
        return q1 * v2.square();
      case 2:
        return sloshing(motion.ddq.col(foreign.first), motion.time[1] - motion.time[0], foreign.a,
                        foreign.b);
      case 3:
        return (foreign.a * q1).cos() * v.sign();
      case 4:
        return (foreign.a * (q1 - 1)).exp();
      case 5:
        return (2 * std::numbers::pi * foreign.a * motion.time.array() + foreign.b).sin();
      case 6:
        return (v1 * v2).tanh();
      default:
        throw std::invalid_argument(
            fmt::format("foreign_torque(): kind {}, expected 0 .. {}", foreign.kind, kKinds - 1));
    }
  };
  return foreign.size * torque();
}

}  // namespace dyngen::test
