// SPDX-License-Identifier: MIT
// Speed of the emitted code beside Orocos KDL, MuJoCo and DART: one process, the same random
// states.
//
//   bench_speed [--markdown] [options of Google Benchmark]
//
// Before anything is timed, all must give the same numbers; exit code 1 if they do not.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <exception>
#include <list>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/speed_contest.h"
#include "tests/bench/speed_report.h"

namespace dyngen::bench {
namespace {

void count_states(benchmark::State& state) {
  state.SetItemsProcessed(static_cast<std::int64_t>(kStates) * state.iterations());
}

/// One iteration of a benchmark is a sweep over all states.
void add_benchmarks(const Contest& contest) {
  for (const auto& [function, by_whom] : contest.calls()) {
    for (const auto& [who, call] : by_whom) {
      benchmark::RegisterBenchmark(benchmark_name(contest.name(), function, who).c_str(),
                                   [call = call, &contest](benchmark::State& state) {
                                     std::vector<double> out(contest.output_size());
                                     for (auto _ : state) {
                                       for (std::size_t k = 0; k < kStates; ++k) {
                                         call(k, out.data());
                                         benchmark::DoNotOptimize(out.data());
                                         benchmark::ClobberMemory();
                                       }
                                     }
                                     count_states(state);
                                   });
    }
  }
  for (const auto& [function, by_whom] : contest.sweeps()) {
    for (const auto& [who, sweep] : by_whom) {
      benchmark::RegisterBenchmark(benchmark_name(contest.name(), function, who).c_str(),
                                   [sweep = sweep](benchmark::State& state) {
                                     for (auto _ : state) {
                                       sweep();
                                       benchmark::ClobberMemory();
                                     }
                                     count_states(state);
                                   });
    }
  }
}

int run(bool markdown) {
  std::list<Contest> contests;  // benchmarks keep references
  std::vector<std::string> names;
  bool good = true;
  for (SpeedRobot& robot : speed_robots()) {
    names.push_back(robot.name);
    contests.emplace_back(std::move(robot));
    good &= contests.back().verify();
  }
  if (!good) {
    fmt::print(stderr, "bench_speed: results differ by more than they may: nothing is timed\n");
    return 1;
  }
  for (const Contest& contest : contests) add_benchmarks(contest);
  KeepingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  const Table table = speed_table(reporter, names);
  fmt::print("\nMedians of CPU time in ns per call over {} random states\n\n{}", kStates,
             markdown ? table.markdown() : table.text());
  return 0;
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) {
  // Nine repetitions in random order, unless the command line says otherwise: a disturbance of the
  // machine then meets all alike.
  std::vector<std::string> arguments = {argv[0], "--benchmark_repetitions=9",
                                        "--benchmark_enable_random_interleaving=true",
                                        "--benchmark_min_time=0.02"};
  bool markdown = false;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--markdown") {
      markdown = true;
    } else {
      arguments.emplace_back(argv[i]);
    }
  }
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;
  try {
    return dyngen::bench::run(markdown);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
