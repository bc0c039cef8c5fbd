// SPDX-License-Identifier: MIT
// Full, physically consistent parameters of arms of two, four and seven links from noisy equations.
//
//   bench_consistency [options of Google Benchmark]
//
// The counter `base` says how many base parameters were measured. Noise is in N m.
#include <benchmark/benchmark.h>

#include "runtime/consistency/consistent_parameters.h"
#include "tests/runtime/consistency/measured_robot.h"

namespace dyngen::bench {
namespace {

constexpr unsigned kSeed = 6;

void consistent_parameters(benchmark::State& state) {
  const int links = static_cast<int>(state.range(0));
  const double noise = 1e-3 * static_cast<double>(state.range(1));
  test::MeasuredRobot robot = test::measured_robot(kSeed, links, noise);
  test::add_noise(robot.problem, kSeed);
  for (auto _ : state) {
    const runtime::ConsistentEstimate estimate = runtime::fit_consistent(robot.problem);
    if (!estimate.converged) state.SkipWithError(estimate.message.c_str());
    benchmark::DoNotOptimize(estimate.chi.data());
  }
  state.counters["base"] = static_cast<double>(robot.problem.K.rows());
}

BENCHMARK(consistent_parameters)
    ->ArgNames({"links", "mNm"})
    ->ArgsProduct({{2, 4, 7}, {1, 1000, 30000}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace dyngen::bench

BENCHMARK_MAIN();
