// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

#include "tests/bench/table.h"

namespace dyngen::bench {

/// Google Benchmark's console output, which also keeps what it prints.
class KeepingReporter : public benchmark::ConsoleReporter {
 public:
  KeepingReporter() : ConsoleReporter(OO_Tabular) {}
  void ReportRuns(const std::vector<Run>& runs) override;

  /// Median over the repetitions, CPU time of one call or sample in ns; NaN if it did not run.
  [[nodiscard]] double median(const std::string& benchmark) const;

 private:
  std::map<std::string, std::vector<double>> times_;
};

/// Name of a benchmark: "puma560/id/dyngen_native".
std::string benchmark_name(const std::string& robot, const std::string& function,
                           const std::string& who);

/// Medians and how many times slower the peers are.
Table speed_table(const KeepingReporter& reporter, const std::vector<std::string>& robots);

}  // namespace dyngen::bench
