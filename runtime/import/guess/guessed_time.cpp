// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "runtime/import/guess/map_guess.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Words of columns that count rows or the ticks of a controller.
constexpr std::array<std::string_view, 17> kCounterWords = {
    {"tick", "ticks", "counter", "count", "cycle", "cycles", "seq", "sequence", "index", "idx",
     "sample", "samples", "frame", "frames", "step", "iteration", "row"}};

/// The step of a counter, whole numbers that rise in nearly all rows; 0: it is none.
double step_of_counter(const VectorXd& values) {
  constexpr Index kFewestRows = 10;
  constexpr double kMostRising = 0.9;
  if (values.size() < kFewestRows || !values.allFinite()) return 0;
  if ((values.array() != values.array().round()).any()) return 0;
  VectorXd steps = values.tail(values.size() - 1) - values.head(values.size() - 1);
  const auto rising = static_cast<double>((steps.array() > 0).count());
  if (rising < kMostRising * static_cast<double>(steps.size())) return 0;
  std::nth_element(steps.begin(), steps.begin() + steps.size() / 2, steps.end());
  return steps[steps.size() / 2];
}

}  // namespace

/// A column without a name that rises by 1 from row to row says nothing of seconds.
bool MapGuess::counts_rows(const SignalCandidate& candidate) const {
  const bool named = std::any_of(candidate.family.pattern.begin(), candidate.family.pattern.end(),
                                 [](char c) { return c < '0' || c > '9'; });
  return !named && candidate.unit.empty() && step_of_counter(values_of(candidate).col(0)) == 1;
}

/// A counter in place of a time: its rate is asked for. @return whether there is one
bool MapGuess::guess_counter() {
  for (const SampledTable& own : logs_.tables) {
    for (std::size_t c = 0; c < own.table.columns.size(); ++c) {
      const std::string& name = own.table.columns[c];
      const std::vector<std::string> words = words_of(name);
      const bool numbered =
          !words.empty() && words.size() == 1 && words[0][0] >= '0' && words[0][0] <= '9';
      const bool counts = std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return std::find(kCounterWords.begin(), kCounterWords.end(), word) != kCounterWords.end();
      });
      if (!counts && !numbered) continue;
      const double step = step_of_counter(own.values.col(static_cast<Index>(c)));
      if (step == 0 || (numbered && step != 1)) continue;
      remark(
          fmt::format("no column is a time. {} is a counter: whole numbers that rise by {:.6g} "
                      "from row to row; a time is a count over its rate",
                      name, step));
      question(fmt::format("at which rate does {} count (such as 1000 Hz)?", name));
      line(fmt::format("time: {{column: {}, rate: \"?\"}}", yaml_text(name)));
      return true;
    }
  }
  return false;
}

/// From the log, the name's end, or the size of a step.
std::string MapGuess::time_unit(const std::string& name, double step, std::string& reason) {
  const std::vector<std::string> words = words_of(name);
  for (const char* unit : {"ns", "us", "ms", "nsec", "usec", "msec"}) {
    if (std::find(words.begin(), words.end(), unit) == words.end()) continue;
    reason = fmt::format("'{}' is in its name", unit);
    return unit;
  }
  // samples of a controller are 0.2 ms to 0.2 s apart
  constexpr double kQuickest = 2e-4, kSlowest = 0.2;
  constexpr std::array<std::pair<const char*, double>, 4> kUnits = {
      {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"ns", 1e-9}}};
  for (const auto& [unit, factor] : kUnits) {
    if (step * factor < kQuickest || step * factor > kSlowest) continue;
    reason = fmt::format("a step of {:.6g} is {:.4g} ms then", step, 1e3 * step * factor);
    return unit;
  }
  return {};
}

void MapGuess::guess_time() {
  const SignalCandidate* best = nullptr;
  for (const SignalCandidate& candidate : candidates_) {
    if (candidate.role != ColumnRole::kTime) continue;
    const VectorXd times = values_of(candidate).col(0);
    if (times.size() < 3) continue;
    const VectorXd steps = times.tail(times.size() - 1) - times.head(times.size() - 1);
    const auto rising = static_cast<double>((steps.array() > 0).count());
    constexpr double kMostRising = 0.9;
    if (rising < kMostRising * static_cast<double>(steps.size())) continue;
    const auto is_stamp = [](const SignalCandidate& one) {
      return std::find(one.family.words.begin(), one.family.words.end(), "stamp") !=
             one.family.words.end();
    };
    if (best == nullptr || (is_stamp(candidate) && !is_stamp(*best))) best = &candidate;
  }
  if (best != nullptr && counts_rows(*best)) best = nullptr;
  if (best == nullptr && guess_counter()) return;
  if (best == nullptr) {
    question("no column is a time: at which rate were the rows taken (such as 1000 Hz)?");
    line("time: {rate: \"?\"}");
    return;
  }
  used_.push_back(best);
  VectorXd times = values_of(*best).col(0);
  std::vector<double> steps(static_cast<std::size_t>(times.size() - 1));
  for (std::size_t k = 0; k < steps.size(); ++k) {
    steps[k] = times[static_cast<Index>(k) + 1] - times[static_cast<Index>(k)];
  }
  std::nth_element(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2),
                   steps.end());
  const double step = steps[steps.size() / 2];
  std::string why = why_unit(*best), unit = best->unit;
  if (unit.empty() || !unit_conversion(unit, ColumnQuantity::kTime)) {
    unit = time_unit(best->family.pattern, step, why);
  }
  const std::string column = yaml_text(best->family.pattern);
  if (unit.empty()) {
    question(fmt::format("in which unit is the time, of which a step is {:.6g}?", step));
    line(fmt::format("time: {{column: {}, unit: \"?\"}}", column));
    return;
  }
  const UnitConversion seconds = *unit_conversion(unit, ColumnQuantity::kTime);
  step_ = seconds(step);
  reason(best->unit == unit ? sure_of_unit(*best) : kSure,
         fmt::format("{} rises from row to row; unit {}: {}; {:.6g} Hz", best->family.pattern, unit,
                     why, 1 / step_));
  line(fmt::format("time: {{column: {}, unit: {}}}", column, unit));
  recording_.time.resize(times.size());
  for (Index k = 0; k < times.size(); ++k) recording_.time[k] = seconds(times[k] - times[0]);
}

}  // namespace dyngen::runtime
