// SPDX-License-Identifier: MIT
// scratch
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "runtime/excitation/excitation.h"
#include "runtime/excitation/multistage.h"
#include "runtime/tools/dynid/excite_limits.h"

using namespace dyngen::runtime;

int main(int argc, char** argv) {
  const std::string robot_path = argv[1];
  const std::string what = argv[2];
  const double seconds = std::atof(argv[3]);
  const int harmonics = std::atoi(argv[4]);
  const double duration = std::atof(argv[5]);
  const int starts = std::atoi(argv[6]);
  auto t0 = std::chrono::steady_clock::now();
  auto since = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - t0).count();
  };
  DescribedRobot robot = describe_robot(robot_path, OpenParameters::kAbsentRows, {.gradient = true});
  fmt::print("described in {:.2f} s, {} parameters\n", since(), robot.linear.size());
  RobotLimits limits = limits_of(robot, {});
  for (auto& n : limits.notes) fmt::print("note: {}\n", n);
  ExcitationOptions o;
  if (what == "inertial") {
    for (int i = 0; i < robot.linear.size(); ++i)
      if (robot.linear.parameters[i].kind == ParameterKind::kInertial)
        o.information.parameters.push_back(i);
  }
  fmt::print("asked: {}\n", o.information.parameters.size());
  o.family.duration = duration;
  o.family.harmonics = harmonics;
  if (argc > 7 && std::string(argv[7]) == "spline") o.family.form = TrajectoryForm::kSpline;
  o.seconds = seconds;
  o.starts = starts;
  {
    auto x = random_trajectory(robot.linear, limits.limits, o.family, 1);
    auto basis = basis_at(o.family, period_times(o.family, 300));
    auto motion = basis.motion(x);
    t0 = std::chrono::steady_clock::now();
    for (int i = 0; i < 20; ++i) information_of(robot.linear, motion, o.information);
    fmt::print("information {:.2f} ms\n", since() * 50);
    auto info = information_of(robot.linear, motion, o.information);
    t0 = std::chrono::steady_clock::now();
    CriterionValue v;
    for (int i = 0; i < 20; ++i) v = evaluate(info.R, o.criterion);
    fmt::print("criterion {:.2f} ms\n", since() * 50);
    t0 = std::chrono::steady_clock::now();
    for (int i = 0; i < 20; ++i)
      information_gradient(robot.linear, motion, o.information, info, v.gradient);
    fmt::print("gradient {:.2f} ms\n", since() * 50);
    t0 = std::chrono::steady_clock::now();
    for (int i = 0; i < 20; ++i) constraints_of(robot.linear, limits.limits, motion, 100);
    fmt::print("constraints {:.2f} ms\n", since() * 50);
  }
  t0 = std::chrono::steady_clock::now();
  Excitation e = excite(robot.linear, limits.limits, o);
  fmt::print("{} {:.1f} s, {} evaluations, found {} {}\n", robot_path, since(), e.evaluations,
             e.found, e.message);
  for (auto& s : e.starts)
    fmt::print("  seed {} random {:.1f} optimised {:.2f}\n", s.seed, s.random, s.optimised);
  auto basis = basis_at(o.family, period_times(o.family, 1000));
  fmt::print("cond {:.2f}, unit columns {:.2f}\n",
             condition_number(robot.linear, basis.motion(e.x), o.information.parameters),
             condition_number(robot.linear, basis.motion(e.x), o.information.parameters, true));
  fmt::print("shares pos {:.3f} vel {:.3f} acc {:.3f} tau {:.3f}\n", e.shares.position.maxCoeff(),
             e.shares.speed.maxCoeff(), e.shares.acceleration.maxCoeff(),
             e.shares.torque.maxCoeff());
}
