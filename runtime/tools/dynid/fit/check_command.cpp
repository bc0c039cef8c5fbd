// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "gen/diagnostic/diagnostic.h"
#include "gen/tool/output_files.h"
#include "runtime/tools/dynid/fit/check_report.h"
#include "runtime/tools/dynid/fit/fit_with_effects.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/recordings/judged.h"
#include "runtime/tools/dynid/recordings/loading.h"
#include "runtime/tools/dynid/two_encoders/two_encoders.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;

VectorXd values_of(const DescribedRobot& robot) {
  VectorXd beta(robot.linear.size());
  std::string unknown;
  for (int i = 0; i < robot.linear.size(); ++i) {
    const LinearParameter& parameter = robot.linear.parameters[static_cast<std::size_t>(i)];
    if (parameter.value) {
      beta[i] = *parameter.value;
    } else {
      unknown += (unknown.empty() ? "" : " ") + parameter.name;
    }
  }
  if (!unknown.empty()) {
    throw ModelError(
        fmt::format("{}: error: parameters are unknown ('*'): {}; expected numbers: "
                    "'dynid fit' finds them\n",
                    robot.file.file_name, unknown));
  }
  return beta;
}

std::string two_encoders_words(const std::vector<int>& joints) {
  std::vector<int> numbers;
  for (const int joint : joints) numbers.push_back(joint + 1);
  return fmt::format("  two encoders: joint{} {}; 'dynid fit' says what they show\n",
                     numbers.size() == 1 ? "" : "s", fmt::join(numbers, ", "));
}

std::string check_text(const CheckReport& report) {
  std::string text = fmt::format("{}: {} joints, {} base parameters, numbers of the file\n",
                                 report.robot, report.revolute.size(), report.base_parameters);
  for (const auto& [line, equations, residual, two_encoders] : report.recordings) {
    text += fmt::format(
        "\n{}: {:.1f} s at {:.6g} Hz, {:.0f} equations a joint, cut-off {:.3g} Hz\n", line.name,
        line.seconds, 1 / line.condition.sample_time, equations, line.cutoff);
    for (const std::string& message : line.condition.messages) text += "  " + message + "\n";
    if (!two_encoders.empty()) text += two_encoders_words(two_encoders);
    if (equations == 0) {
      text += "  no equations, so nothing is known of these numbers\n";
      continue;
    }
    text += fmt::format("{:<14}{:>12}{:>12}\n", "residual", "rms", "% torque");
    for (std::size_t j = 0; j < report.revolute.size(); ++j) {
      const auto place = static_cast<Eigen::Index>(j);
      const auto number = [](double value, const char* format) {
        return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : std::string("-");
      };
      text += fmt::format("{:<14}{:>8} {:<3}{:>12}\n", fmt::format("joint {}", j + 1),
                          number(residual.rms[place], "{:.4g}"), report.revolute[j] ? "N m" : "N",
                          number(residual.percent[place], "{:.1f}"));
    }
  }
  return text;
}

}  // namespace

int run_check(const ToolOptions& options) {
  ProgressLine progress("dynid");
  const DescribedRobot robot = describe_robot(options.robot, OpenParameters::kAsWritten);
  const VectorXd beta = values_of(robot);
  const EffectTask task = EffectTask::of(robot, options);
  const ToolOptions reading = task.reading(options);
  LoadedRecordings loaded = load_recordings(options.recordings, reading, false, progress), none;
  settle_cutoff(task.effects.empty() ? &robot.linear : nullptr, loaded, none, reading, progress);
  judge_recordings(robot, loaded.sources, options, progress);
  CheckReport report;
  report.robot = robot.linear.name;
  report.revolute = robot.linear.revolute;
  report.base_parameters = robot.linear.size();
  std::vector<std::string> reasons = loaded.left_out;
  for (std::size_t i = 0; i < loaded.sources.size(); ++i) {
    progress.show("equations of " + loaded.sources[i].name, i, loaded.sources.size());
    const RowSource rows = task.effects.empty()
                               ? rows_of(robot.linear, loaded.sources[i], options.rows)
                               : rows_beside_effects(task, robot, options, loaded.sources[i], beta);
    const TorqueFactor equations = factor_of(rows, robot.linear.columns, robot.linear.size());
    report.recordings.push_back({loaded.lines[i], equations.samples(), residual_of(equations, beta),
                                 joints_with_two_encoders({loaded.sources[i]})});
    RecordingLine& line = report.recordings.back().line;
    line.equations = equations_of(equations);
    const std::string reason = why_no_equations(line, options.rows);
    if (!reason.empty()) reasons.push_back(reason);
  }
  progress.clear();
  if (!options.json.empty()) write_files({{options.json, check_json(report)}});
  std::cout << check_text(report);
  for (const std::string& reason : reasons) std::cerr << reason << "\n";
  return reasons.empty() ? kDone : kCannotAnswer;
}

}  // namespace dyngen::runtime
