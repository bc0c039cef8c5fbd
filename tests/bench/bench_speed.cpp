// SPDX-License-Identifier: MIT
// Speed of the emitted code beside Orocos KDL, MuJoCo and DART: one process, the same random
// states.
//
//   bench_speed [--markdown] [options of Google Benchmark]
//
// Before anything is timed, all must agree with the judge; exit code 1 if they do not.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <exception>
#include <list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/bench/speed_contest.h"
#include "tests/bench/speed_report.h"

namespace dyngen::bench {
namespace {

/// Robots that are shown in one table.
struct Group {
  std::string title;
  std::list<Contest> contests;  // benchmarks keep references

  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const Contest& contest : contests) result.push_back(contest.robot.name);
    return result;
  }
};

Group make_group(const std::string& title, std::vector<SpeedRobot> robots) {
  Group group{title, {}};
  for (SpeedRobot& robot : robots) group.contests.emplace_back(std::move(robot));
  return group;
}

int run(bool markdown) {
  std::list<Group> groups;
  groups.push_back(
      make_group("Robot files with their drives, all numbers in the code (--parameters baked)",
                 robots_of_files()));
  groups.push_back(make_group(
      "Convention (a): ten inertial parameters of every link, none zero, read at run time as base "
      "parameters; no drives; lengths in the code (--parameters runtime)",
      robots_at_run_time()));
  bool good = true;
  for (const Group& group : groups) {
    for (const Contest& contest : group.contests) good &= verify(contest);
  }
  if (!good) {
    fmt::print(stderr, "bench_speed: results differ: nothing is timed\n");
    return 1;
  }
  for (const Group& group : groups) {
    for (const Contest& contest : group.contests) add_benchmarks(contest);
  }
  KeepingReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  fmt::print(
      "\nMedians of CPU time in ns per call over {} random states; of a batch, per sample of "
      "{}\n",
      kStates, kBatch);
  for (const Group& group : groups) {
    const Table table = speed_table(reporter, group.names());
    fmt::print("\n{}\n\n{}", group.title, markdown ? table.markdown() : table.text());
  }
  return 0;
}

}  // namespace
}  // namespace dyngen::bench

int main(int argc, char** argv) {
  // Nine repetitions in random order, unless the command line says otherwise: a disturbance of the
  // machine then meets all alike.
  std::vector<std::string> arguments = {argv[0], "--benchmark_repetitions=9",
                                        "--benchmark_enable_random_interleaving=true",
                                        "--benchmark_min_time=0.05"};
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
