// SPDX-License-Identifier: MIT
// Time of one step of every control law over generated C.
//
//   bench_control [options of Google Benchmark]
//
// The UR10e and the Panda of the tests, friction compensated at the measured velocity, torque
// limits on. A benchmark's time is the mean; beside it stand the median and the worst time of a
// million single steps in nanoseconds, read from a clock whose own time is not subtracted.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <vector>

#include "bench_control_panda.h"
#include "bench_control_ur10e.h"
#include "runtime/control/controller.h"

namespace dyngen::bench {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kStates = 512;

struct States {
  MatrixXd q, dq, q_ref, dq_ref, ddq_ref;  // (n x kStates)

  explicit States(Index joints) {
    std::mt19937_64 random(20261121);
    std::normal_distribution<double> normal;
    for (MatrixXd* part : {&q, &dq, &q_ref, &dq_ref, &ddq_ref}) {
      *part = MatrixXd::NullaryExpr(joints, kStates, [&] { return normal(random); });
    }
  }
  [[nodiscard]] runtime::ControlInput input(Index k) const {
    return {q.col(k).data(), dq.col(k).data(), q_ref.col(k).data(), dq_ref.col(k).data(),
            ddq_ref.col(k).data()};
  }
};

runtime::ControllerOptions options_of(runtime::ControlLaw law, int joints) {
  runtime::ControllerOptions options;
  options.law = law;
  options.gains = runtime::acceleration_gains(joints, 3, 1);
  options.friction = law != runtime::ControlLaw::kPd;
  options.friction_velocity = runtime::FrictionVelocity::kMeasured;
  options.torque_limit = VectorXd::Constant(joints, 300);
  return options;
}

void run(benchmark::State& state, const runtime::ModelFunctions& functions,
         runtime::ControlLaw law) {
  using Clock = std::chrono::steady_clock;
  runtime::Controller controller(runtime::control_model(functions), options_of(law, functions.nq));
  const States states(functions.nq);
  VectorXd tau(functions.nq);
  Index k = 0;
  for (auto _ : state) {
    controller.step(states.input(k), tau.data());
    benchmark::DoNotOptimize(tau.data());
    k = (k + 1) % kStates;
  }
  constexpr std::size_t kSteps = 1000000;
  std::vector<double> times(kSteps);
  for (std::size_t i = 0; i < kSteps; ++i) {
    const Clock::time_point begin = Clock::now();
    controller.step(states.input(static_cast<Index>(i) % kStates), tau.data());
    benchmark::DoNotOptimize(tau.data());
    times[i] = std::chrono::duration<double, std::nano>(Clock::now() - begin).count();
  }
  std::nth_element(times.begin(), times.begin() + kSteps / 2, times.end());
  state.counters["median_ns"] = times[kSteps / 2];
  std::nth_element(times.begin(), times.begin() + kSteps / 10000 * 9999, times.end());
  state.counters["p99.99_ns"] = times[kSteps / 10000 * 9999];
  state.counters["worst_ns"] = *std::max_element(times.begin(), times.end());
}

void register_all(const runtime::ModelFunctions& functions) {
  for (const auto law : {runtime::ControlLaw::kPd, runtime::ControlLaw::kGravity,
                         runtime::ControlLaw::kFeedforward, runtime::ControlLaw::kComputedTorque}) {
    benchmark::RegisterBenchmark(
        (functions.name + "/" + runtime::law_name(law)).c_str(),
        [functions, law](benchmark::State& state) { run(state, functions, law); });
  }
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) {
  dyngen::bench::register_all(
      {"ur10e",
       BENCH_CONTROL_UR10E_NQ,
       {bench_control_ur10e_joint_names, bench_control_ur10e_joint_names + BENCH_CONTROL_UR10E_NQ},
       bench_control_ur10e_id,
       bench_control_ur10e_gravity,
       nullptr,
       bench_control_ur10e_friction});
  dyngen::bench::register_all(
      {"panda",
       BENCH_CONTROL_PANDA_NQ,
       {bench_control_panda_joint_names, bench_control_panda_joint_names + BENCH_CONTROL_PANDA_NQ},
       bench_control_panda_id,
       bench_control_panda_gravity,
       nullptr,
       bench_control_panda_friction});
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
