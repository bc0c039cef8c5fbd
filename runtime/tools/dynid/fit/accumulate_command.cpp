// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iostream>
#include <stdexcept>

#include "gen/tool/output_files.h"
#include "runtime/identification/summary_file.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/recordings/summed.h"

namespace dyngen::runtime {
namespace {

std::string text_of(const RobotSummaries& all, const std::string& path) {
  std::string text;
  for (const auto& [name, summary] : all.robots) {
    text += fmt::format("{}{}{}: {} recordings, {:.1f} s, {:.0f} equations a joint\n", all.model,
                        name.empty() ? "" : " ", name, summary.recordings, summary.seconds(),
                        summary.equations.samples());
  }
  return text + "written: " + path + "\n";
}

}  // namespace

int run_accumulate(const ToolOptions& options) {
  ProgressLine progress("dynid");
  const DescribedRobot robot = describe_robot(options.robot, OpenParameters::kAbsentRows);
  refuse_without_parameters(robot);
  RobotSummaries all = empty_summaries(robot.linear);
  RecordingSummary sum = empty_summary(robot.linear.columns, robot.linear.size());
  if (!add_recordings_to(sum, robot, options.recordings, options, progress)) {
    std::cerr << "dynid: there are no equations to add up; nothing was written\n";
    return kCannotAnswer;
  }
  all.robots.emplace(options.robot_name, std::move(sum));
  progress.clear();
  write_files({{options.output, write_summaries(all)}});
  std::cout << text_of(all, options.output);
  return kDone;
}

int run_merge(const ToolOptions& options) {
  RobotSummaries all = read_summary_file(options.recordings.front());
  for (std::size_t i = 1; i < options.recordings.size(); ++i) {
    try {
      merge(all, read_summary_file(options.recordings[i]));
    } catch (const std::invalid_argument& error) {
      throw SummaryFileError(fmt::format("{}: error: it does not go with {}: {}",
                                         options.recordings[i], options.recordings.front(),
                                         error.what()));
    }
  }
  write_files({{options.output, write_summaries(all)}});
  std::cout << text_of(all, options.output);
  return kDone;
}

}  // namespace dyngen::runtime
