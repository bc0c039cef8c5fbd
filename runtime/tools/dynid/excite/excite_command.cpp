// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iostream>
#include <string>

#include "gen/tool/progress_line.h"
#include "runtime/tools/dynid/excite/excite_picture.h"
#include "runtime/tools/dynid/excite/excite_report.h"
#include "runtime/tools/dynid/excite/programme_report.h"
#include "runtime/tools/dynid/excite/separation_report.h"
#include "runtime/tools/dynid/options/commands.h"
#include "runtime/tools/dynid/page/page_output.h"

namespace dyngen::runtime {
namespace {

int run_separate(const ToolOptions& options, ProgressLine& progress) {
  const auto tell = [&](const std::string& what, std::size_t place, std::size_t all) {
    progress.show(what, place, all);
  };
  const SeparationReport report = make_separation_report(options.robot, options.excite, tell);
  progress.clear();
  std::vector<OutputFile> files;
  if (!options.json.empty()) {
    files.push_back({options.json, separation_json(report, options.output)});
  }
  const std::vector<std::string> made = write_with_page(
      options.page, [&] { return separation_document(report, options.page.command); }, progress,
      std::move(files));
  std::cout << separation_text(report);
  tell_written(made);
  if (!report.designed.found) return kCannotAnswer;
  write_trajectory(report.trajectory, options.output);
  std::cout << fmt::format("written: {}, {} rows\n", options.output, report.trajectory.samples());
  if (!options.excite.picture.empty()) {
    draw(motion_picture(report.robot.linear, report.limits, report.trajectory, report.samples + 1,
                        fmt::format("{}: {} apart from {}", report.robot.linear.name,
                                    report.finding.family, fmt::join(report.rivals, ", "))),
         options.excite.picture);
    std::cout << fmt::format("written: {}\n", options.excite.picture);
  }
  return kDone;
}

int run_programme(const ToolOptions& options, ProgressLine& progress) {
  progress.show("programme", 0, 1);
  const ProgrammeReport report = make_programme_report(options.robot, options.excite);
  progress.clear();
  std::vector<OutputFile> files;
  if (!options.json.empty()) {
    files.push_back({options.json, programme_json(report, options.output)});
  }
  const std::vector<std::string> made = write_with_page(
      options.page, [&] { return programme_document(report, options.page.command); }, progress,
      std::move(files));
  std::cout << programme_text(report);
  tell_written(made);
  if (!report.found) return kCannotAnswer;
  write_trajectory(report.trajectory, options.output);
  std::cout << fmt::format("written: {}, {} rows\n", options.output, report.trajectory.samples());
  if (!options.excite.picture.empty()) {
    draw(motion_picture(report.robot.linear, report.limits, report.trajectory, report.samples + 1,
                        fmt::format("{}: {}", report.robot.linear.name, options.excite.archetype)),
         options.excite.picture);
    std::cout << fmt::format("written: {}\n", options.excite.picture);
  }
  return kDone;
}

}  // namespace

int run_excite(const ToolOptions& options) {
  ProgressLine progress("dynid");
  if (!options.excite.findings.empty()) return run_separate(options, progress);
  if (!options.excite.archetype.empty()) return run_programme(options, progress);
  const ExciteReport report = make_excite_report(options, progress);
  progress.clear();
  std::vector<OutputFile> files;
  if (!options.json.empty()) files.push_back({options.json, json_of(report, options.output)});
  const std::vector<std::string> made = write_with_page(
      options.page, [&] { return excite_document(report, options.page.command); }, progress,
      std::move(files));
  std::cout << text_of(report);
  tell_written(made);
  if (!report.found) return kCannotAnswer;
  write_trajectory(report.trajectory, options.output);
  std::cout << fmt::format("written: {}, {} rows\n", options.output, report.trajectory.samples());
  if (!options.excite.picture.empty()) {
    draw(picture_of(report), options.excite.picture);
    std::cout << fmt::format("written: {}\n", options.excite.picture);
  }
  return kDone;
}

}  // namespace dyngen::runtime
