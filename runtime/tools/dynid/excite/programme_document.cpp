// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <utility>

#include "runtime/tools/dynid/excite/motion_charts.h"
#include "runtime/tools/dynid/excite/programme_report.h"
#include "runtime/tools/dynid/page/page_parts.h"

namespace dyngen::runtime {
namespace {

std::string programme_sentence(const ProgrammeReport& report) {
  if (!report.found) return "No programme: " + report.message + ".";
  return fmt::format("A programme of {} that takes {:.4g} s.", report.options.archetype,
                     report.duration);
}

ReportTable steps_table(const ProgrammeReport& report) {
  ReportTable table{
      {"joint", "begins [s]", "lasts [s]", "speed", "from", "to", "side"}, {}, kRowsShown};
  for (const ProgrammeStep& step : report.programme.steps) {
    table.rows.push_back({joint_words(step.joint), step.begin, step.seconds, step.speed, step.from,
                          step.to,
                          step.side == 0  ? ""
                          : step.side < 0 ? "from below"
                                          : "from above"});
  }
  return table;
}

}  // namespace

ReportDocument programme_document(const ProgrammeReport& report, const std::string& command) {
  const LinearModel& model = report.robot.linear;
  ReportDocument document;
  document.kind = "excitation";
  document.title = model.name;
  document.subtitle = "Steady speeds and poses, by dynid excite";
  document.origin = fmt::format("dynid {}.", DYNGEN_VERSION);
  std::vector<ReportBlock> further;
  if (!report.notes.empty()) further.emplace_back(ReportList{report.notes});
  document.sections.push_back(
      first_screen("Result", programme_sentence(report), std::move(further),
                   report.found ? motion_arm(report.robot, report.trajectory) : ReportArm{},
                   limit_bars(model, report.limits, report.shares)));
  if (report.found) {
    document.sections.push_back(
        section_of("trajectory", "The motion",
                   {ReportText{sentence(programme_advice(report))},
                    motion_chart(model, report.limits, report.trajectory, report.samples + 1)}));
  }
  document.sections.push_back(section_of("steps", "Runs and poses", {steps_table(report)}));
  document.sections.push_back(origin_section(command, document.origin));
  return document;
}

}  // namespace dyngen::runtime
