// SPDX-License-Identifier: MIT
// Motions whose joints run at constant speeds.
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "tests/blind/simulation/motion.h"

namespace blind {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kSlowest = 0.05;                        // of the limit of speed
constexpr double kFarthest = 0.42;                       // of the range, from its middle
constexpr double kShortestHold = 0.1, kLongestHold = 4;  // s at constant speed

/// One run at a constant speed. The speed rises and falls as 3 u^2 - 2 u^3.
struct Run {
  double begin, ramp, hold;  // s
  double from, speed;        // rad, rad/s

  double end() const { return begin + 2 * ramp + hold; }
  double goal() const { return from + speed * (ramp + hold); }
};

struct JointState {
  double q = 0, dq = 0, ddq = 0;
};

JointState state_of(const Run& run, double t) {
  const auto rise = [&](double u) {
    return JointState{run.ramp * u * u * u * (1 - u / 2), u * u * (3 - 2 * u),
                      6 * u * (1 - u) / run.ramp};
  };
  t -= run.begin;
  JointState way;
  if (t < run.ramp) {
    way = rise(t / run.ramp);
  } else if (t < run.ramp + run.hold) {
    way = {t - run.ramp / 2, 1, 0};
  } else {
    way = rise((2 * run.ramp + run.hold - t) / run.ramp);
    way = {run.ramp + run.hold - way.q, way.dq, -way.ddq};
  }
  return {run.from + run.speed * way.q, run.speed * way.dq, run.speed * way.ddq};
}

using Runs = std::vector<Run>;  // of one joint, one after the other

double place_of(const Arm& arm, Index j, double share) {
  return (arm.q_min[j] + arm.q_max[j]) / 2 + share * (arm.q_max[j] - arm.q_min[j]);
}

/// Lets a joint run there and back between two times; it may end before the second.
void add_runs(const Arm& arm, Index j, double from, double begin, double end, Random& random,
              Runs& runs) {
  double t = begin, q = from;
  while (true) {
    const double middle = place_of(arm, j, 0);
    const double goal = place_of(arm, j, (q > middle ? -1 : 1) * random.between(0.05, kFarthest));
    const double fastest = random.decade(kSlowest, kSpeed) * arm.v_max[j];
    const double ramp =
        std::max(0.05, 1.5 * fastest / (kAcceleration * arm.a_max[j])) * random.between(1, 1.5);
    const double way = std::min(std::abs(goal - q), fastest * (ramp + kLongestHold));
    const double speed = std::min(fastest, way / (ramp + kShortestHold));
    const Run run{t, ramp, way / speed - ramp, q, goal > q ? speed : -speed};
    if (run.end() > end) return;
    runs.push_back(run);
    q = run.goal();
    t = run.end() + random.between(0.1, 0.5);
  }
}

Motion motion_of(double duration, const VectorXd& start, std::vector<Runs> all) {
  const auto shared = std::make_shared<const std::vector<Runs>>(std::move(all));
  return {
      duration, false, [=](double t) {
        const Index n = start.size();
        Wanted wanted{start, VectorXd::Zero(n), VectorXd::Zero(n)};
        for (Index j = 0; j < n; ++j) {
          const Runs& runs = (*shared)[static_cast<std::size_t>(j)];
          const auto next = std::upper_bound(
              runs.begin(), runs.end(), t, [](double now, const Run& r) { return now < r.begin; });
          if (next == runs.begin()) continue;
          const Run& run = *std::prev(next);
          const JointState now = t < run.end() ? state_of(run, t) : JointState{run.goal(), 0, 0};
          wanted.q[j] = now.q;
          wanted.dq[j] = now.dq;
          wanted.ddq[j] = now.ddq;
        }
        return wanted;
      }};
}

VectorXd drawn_posture(const Arm& arm, Random& random) {
  VectorXd q(arm.joints());
  for (Index j = 0; j < q.size(); ++j) q[j] = place_of(arm, j, random.between(-0.35, 0.35));
  return q;
}

}  // namespace

Motion speed_steps(const Arm& arm, double duration, Random random) {
  const VectorXd start = drawn_posture(arm, random);
  std::vector<Runs> all(static_cast<std::size_t>(arm.joints()));
  for (Index j = 0; j < arm.joints(); ++j) {
    const double begin = random.between(0.2, 0.6);
    add_runs(arm, j, start[j], begin, duration, random, all[static_cast<std::size_t>(j)]);
  }
  return motion_of(duration, start, std::move(all));
}

Motion single_joint_sweeps(const Arm& arm, double duration, Random random) {
  const VectorXd start = drawn_posture(arm, random);
  const Index n = arm.joints();
  std::vector<Runs> all(static_cast<std::size_t>(n));
  const double each = duration / static_cast<double>(n);
  for (Index j = 0; j < n; ++j) {
    const double begin = each * static_cast<double>(j) + 0.3;
    add_runs(arm, j, start[j], begin, begin + each - 0.3, random, all[static_cast<std::size_t>(j)]);
  }
  return motion_of(duration, start, std::move(all));
}

}  // namespace blind
