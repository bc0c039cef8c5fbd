// SPDX-License-Identifier: MIT
// What one step of the search for an exciting trajectory costs: 300 samples, all base parameters.
#include <benchmark/benchmark.h>

#include <string>

#include "runtime/excitation/excitation.h"
#include "runtime/tools/dynid/excite/excite_limits.h"

namespace dyngen::runtime {
namespace {

constexpr Eigen::Index kSamples = 300;

/// A random motion of a robot of robots/.
struct Case {
  DescribedRobot robot;
  MotionLimits limits;
  JointMotion motion;
};

Case make_case(const std::string& name) {
  Case one;
  one.robot = describe_robot(std::string(DYNGEN_SOURCE_DIR "/robots/") + name + ".robot",
                             OpenParameters::kAbsentRows, {.gradient = true});
  one.limits = limits_of(one.robot, {}).limits;
  const TrajectoryFamily family;
  one.motion = basis_at(family, period_times(family, kSamples))
                   .motion(random_trajectory(one.robot.linear, one.limits, family, 1));
  return one;
}

void information(benchmark::State& state, const std::string& name) {
  const Case one = make_case(name);
  for (auto _ : state) {
    benchmark::DoNotOptimize(information_of(one.robot.linear, one.motion, {}));
  }
}

void criterion(benchmark::State& state, const std::string& name) {
  const Case one = make_case(name);
  const Information all = information_of(one.robot.linear, one.motion, {});
  for (auto _ : state) benchmark::DoNotOptimize(evaluate(all.R, {}));
}

void gradient(benchmark::State& state, const std::string& name) {
  const Case one = make_case(name);
  const Information all = information_of(one.robot.linear, one.motion, {});
  const CriterionValue value = evaluate(all.R, {});
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        information_gradient(one.robot.linear, one.motion, {}, all, value.gradient));
  }
}

void constraints(benchmark::State& state, const std::string& name) {
  const Case one = make_case(name);
  for (auto _ : state) {
    benchmark::DoNotOptimize(constraints_of(one.robot.linear, one.limits, one.motion, 100));
  }
}

BENCHMARK_CAPTURE(information, panda, "panda")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(criterion, panda, "panda")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(gradient, panda, "panda")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(constraints, panda, "panda")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(information, ur10e, "ur10e")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(criterion, ur10e, "ur10e")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(gradient, ur10e, "ur10e")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(constraints, ur10e, "ur10e")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dyngen::runtime

BENCHMARK_MAIN();
