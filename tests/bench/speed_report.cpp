// SPDX-License-Identifier: MIT
#include "tests/bench/speed_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/bench/speed_states.h"

namespace dyngen::bench {
namespace {

std::string ns(double time) { return std::isnan(time) ? "-" : fmt::format("{:.1f}", time); }
std::string ratio(double time, double own) {
  return std::isnan(time / own) ? "-" : fmt::format("{:.1f}", time / own);
}

}  // namespace

void KeepingReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.error_occurred || run.run_type != Run::RT_Iteration) continue;
    const double seconds = run.cpu_accumulated_time / static_cast<double>(run.iterations);
    times_[run.run_name.function_name].push_back(1e9 * seconds / static_cast<double>(kStates));
  }
  ConsoleReporter::ReportRuns(runs);
}

double KeepingReporter::median(const std::string& benchmark) const {
  const auto found = times_.find(benchmark);
  if (found == times_.end()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> times = found->second;
  std::sort(times.begin(), times.end());
  const std::size_t half = times.size() / 2;
  return times.size() % 2 == 1 ? times[half] : (times[half - 1] + times[half]) / 2;
}

std::string benchmark_name(const std::string& robot, const std::string& function,
                           const std::string& who) {
  return robot + "/" + function + "/" + who;
}

Table speed_table(const KeepingReporter& reporter, const std::vector<std::string>& robots) {
  const std::vector<std::string> peers = {"KDL", "MuJoCo", "DART"};
  Table table;
  table.header = {"function", "robot", "-O2", "native"};
  table.header.insert(table.header.end(), peers.begin(), peers.end());
  for (const std::string& peer : peers) table.header.push_back(peer + "/native");
  for (const std::string function :
       {"id", "id_libm", "id_baked", "gravity", "mass_matrix", "base_regressor", "fd",
        "id_derivatives", "id_batch", "id_batch_float", "sin_cos", "id_evaluated"}) {
    for (const std::string& robot : robots) {
      const auto time = [&](const std::string& who) {
        return reporter.median(benchmark_name(robot, function, who));
      };
      const double native = time("native");
      std::vector<std::string> row = {function, robot, ns(time("-O2")), ns(native)};
      for (const std::string& peer : peers) row.push_back(ns(time(peer)));
      for (const std::string& peer : peers) row.push_back(ratio(time(peer), native));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace dyngen::bench
