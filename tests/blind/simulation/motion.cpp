// SPDX-License-Identifier: MIT
#include "tests/blind/simulation/motion.h"

#include <algorithm>
#include <numbers>
#include <vector>

namespace blind {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Motion fourier_motion(const Arm& arm, double duration, Random random, Index harmonics) {
  const Index n = arm.joints();
  const double w = 2 * std::numbers::pi / duration;
  MatrixXd a(n, harmonics), b(n, harmonics);
  for (Index j = 0; j < n; ++j) {
    for (Index h = 0; h < harmonics; ++h) {
      a(j, h) = random.normal() / static_cast<double>(h + 1);
      b(j, h) = random.normal() / static_cast<double>(h + 1);
    }
  }
  VectorXd middle = VectorXd::Zero(n);
  const auto at = [=](const VectorXd& centre, const MatrixXd& sine, const MatrixXd& cosine,
                      double t) {
    Wanted wanted{centre, VectorXd::Zero(n), VectorXd::Zero(n)};
    for (Index h = 0; h < harmonics; ++h) {
      const double k = w * static_cast<double>(h + 1);
      const double s = std::sin(k * t), c = std::cos(k * t);
      wanted.q += s * sine.col(h) + c * cosine.col(h);
      wanted.dq += k * (c * sine.col(h) - s * cosine.col(h));
      wanted.ddq -= k * k * (s * sine.col(h) + c * cosine.col(h));
    }
    return wanted;
  };
  VectorXd low = VectorXd::Constant(n, 1e9), high = -low, speed = VectorXd::Zero(n), push = speed;
  const int looks = std::max(400, 80 * static_cast<int>(harmonics));
  for (int i = 0; i < looks; ++i) {
    const Wanted here = at(middle, a, b, duration * i / looks);
    low = low.cwiseMin(here.q);
    high = high.cwiseMax(here.q);
    speed = speed.cwiseMax(here.dq.cwiseAbs());
    push = push.cwiseMax(here.ddq.cwiseAbs());
  }
  for (Index j = 0; j < n; ++j) {
    const double room = kRange * (arm.q_max[j] - arm.q_min[j]);
    const double size =
        std::min({kSpeed * arm.v_max[j] / speed[j], kAcceleration * arm.a_max[j] / push[j],
                  room / (high[j] - low[j])}) *
        random.between(0.7, 1);
    a.row(j) *= size;
    b.row(j) *= size;
    const double left = room - size * (high[j] - low[j]);
    const double begin = (arm.q_min[j] + arm.q_max[j] - room) / 2 + left * random.unit();
    middle[j] = begin - size * low[j];
  }
  return {duration, true, [=](double t) { return at(middle, a, b, t); }};
}

Motion point_to_point(const Arm& arm, double duration, Random random, const Moves& moves_of) {
  const Index n = arm.joints();
  struct Move {
    double begin, end;
    VectorXd from, to;
  };
  std::vector<Move> moves;
  const auto posture = [&] {
    VectorXd q(n);
    for (Index j = 0; j < n; ++j) {
      const double middle = (arm.q_min[j] + arm.q_max[j]) / 2;
      q[j] = middle + random.between(-0.35, 0.35) * (arm.q_max[j] - arm.q_min[j]);
    }
    return q;
  };
  VectorXd from = posture();
  double t = 0.3;
  while (t < duration) {
    const VectorXd to = posture();
    double needed = 0.5;
    for (Index j = 0; j < n; ++j) {
      const double way = std::abs(to[j] - from[j]);  // peaks of the polynomial: 1.875 and 5.774
      needed = std::max({needed, 1.875 * way / (moves_of.speed * arm.v_max[j]),
                         std::sqrt(5.774 * way / (kAcceleration * arm.a_max[j]))});
    }
    moves.push_back({t, t + needed, from, to});
    t += needed + random.between(moves_of.shortest_rest, moves_of.longest_rest);
    from = to;
  }
  return {duration, false, [=](double now) {
            Wanted wanted{moves.front().from, VectorXd::Zero(n), VectorXd::Zero(n)};
            for (const Move& move : moves) {
              if (now < move.begin) break;
              const double T = move.end - move.begin;
              const double s = std::min(1.0, (now - move.begin) / T);
              const VectorXd way = move.to - move.from;
              wanted.q = move.from + way * (s * s * s * (10 + s * (-15 + 6 * s)));
              wanted.dq = way * (30 * s * s * (1 - s) * (1 - s) / T);
              wanted.ddq = way * (60 * s * (1 - s) * (1 - 2 * s) / (T * T));
            }
            return wanted;
          }};
}

}  // namespace blind
