// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iostream>
#include <nlohmann/json.hpp>

#include "gen/diagnostic/diagnostic.h"
#include "gen/tool/output_files.h"
#include "runtime/tools/dynid/fit/fit_with_effects.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/recordings/loading.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;
using Json = nlohmann::ordered_json;

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

}  // namespace

int run_check(const ToolOptions& options) {
  ProgressLine progress("dynid");
  const DescribedRobot robot = describe_robot(options.robot, OpenParameters::kAsWritten);
  const VectorXd beta = values_of(robot);
  const EffectTask task = EffectTask::of(robot, options);
  const LoadedRecordings loaded =
      load_recordings(options.recordings, task.reading(options), false, progress);
  std::string text = fmt::format("{}: {} joints, {} base parameters, numbers of the file\n",
                                 robot.linear.name, robot.linear.joints(), robot.linear.size());
  Json files = Json::array();
  for (std::size_t i = 0; i < loaded.sources.size(); ++i) {
    progress.show("equations of " + loaded.sources[i].name, i, loaded.sources.size());
    const RowSource rows = task.effects.empty()
                               ? rows_of(robot.linear, loaded.sources[i], options.rows)
                               : rows_beside_effects(task, robot, options, loaded.sources[i], beta);
    const TorqueFactor equations = factor_of(rows, robot.linear.columns, robot.linear.size());
    const Residual residual = residual_of(equations, beta);
    const RecordingLine& line = loaded.lines[i];
    text += fmt::format(
        "\n{}: {:.1f} s at {:.6g} Hz, {:.0f} equations a joint, cut-off {:.3g} Hz\n", line.name,
        line.seconds, 1 / line.condition.sample_time, equations.samples(), line.cutoff);
    for (const std::string& message : line.condition.messages) text += "  " + message + "\n";
    text += fmt::format("{:<14}{:>12}{:>12}\n", "residual", "rms", "% torque");
    for (int j = 0; j < robot.linear.joints(); ++j) {
      text += fmt::format(
          "{:<14}{:>8.4g} {:<3}{:>12.1f}\n", fmt::format("joint {}", j + 1), residual.rms[j],
          robot.linear.revolute[static_cast<std::size_t>(j)] ? "N m" : "N", residual.percent[j]);
    }
    Json repairs = Json::array();
    for (const Notice& notice : line.condition.repairs) repairs.push_back(notice.text());
    files.push_back(
        {{"file", line.name},
         {"seconds", line.seconds},
         {"sample_time", line.condition.sample_time},
         {"jitter", line.condition.jitter},
         {"cutoff_hz", line.cutoff},
         {"equations", equations.samples()},
         {"rms", std::vector<double>(residual.rms.begin(), residual.rms.end())},
         {"percent", std::vector<double>(residual.percent.begin(), residual.percent.end())},
         {"repairs", repairs},
         {"messages", line.condition.messages}});
  }
  progress.clear();
  if (!options.json.empty()) {
    const Json json = {{"schema", "dynid.check/1"},
                       {"robot", robot.linear.name},
                       {"joints", robot.linear.joints()},
                       {"base_parameters", robot.linear.size()},
                       {"recordings", files}};
    write_files({{options.json, json.dump(2) + "\n"}});
  }
  std::cout << text;
  return kDone;
}

}  // namespace dyngen::runtime
