// SPDX-License-Identifier: MIT
#include "tests/bench/speed_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
    times_[run.run_name.function_name].push_back(1e9 / run.counters.at("items_per_second"));
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
  Table table;
  table.header = {"function", "robot",  "-O2",  "native",     "sin/cos alone", "evaluate",
                  "KDL",      "MuJoCo", "DART", "KDL/native", "MuJoCo/native"};
  for (const std::string function : {"id", "id libm", "id_batch", "id_batch float", "gravity",
                                     "mass_matrix", "base_regressor", "fd", "id_derivatives"}) {
    for (const std::string& robot : robots) {
      const auto time = [&](const std::string& who) {
        return reporter.median(benchmark_name(robot, function, who));
      };
      const double native = time("dyngen_native"), kdl = time("kdl"), mujoco = time("mujoco");
      table.rows.push_back({function, robot, ns(time("dyngen_O2")), ns(native), ns(time("sin_cos")),
                            ns(time("evaluate")), ns(kdl), ns(mujoco), ns(time("dart")),
                            ratio(kdl, native), ratio(mujoco, native)});
    }
  }
  return table;
}

}  // namespace dyngen::bench
