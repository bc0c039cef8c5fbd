// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "runtime/tools/dynid/excite/excite_report.h"
#include "runtime/tools/dynid/excite/programme_report.h"

namespace dyngen::runtime {

std::string programme_advice(const ProgrammeReport& report) {
  const bool poses = report.asked.kind == ProgrammeKind::kPoses;
  return fmt::format(
      "record it at {:.6g} Hz or a multiple, raw (without a filter of the controller); 'dynid fit' "
      "and 'dynid diagnose' read the mean torque of every {}",
      report.options.rate, poses ? "pose" : "run");
}

std::string programme_text(const ProgrammeReport& report) {
  const LinearModel& model = report.robot.linear;
  std::string text = fmt::format("{}: {} joints, programme of {}\n", model.name, model.joints(),
                                 report.options.archetype);
  for (const std::string& note : report.notes) text += "  " + note + "\n";
  const bool poses = report.asked.kind == ProgrammeKind::kPoses;
  text += fmt::format("\n{:<14}{:>10}{:>14}{:>14}{:>12}{:>12}\n", "joint", poses ? "poses" : "runs",
                      "slowest", "fastest", "shortest s", "longest s");
  for (const ProgrammeLine& line : programme_lines(report)) {
    text += fmt::format("{:<14}{:>10}{:>14.4g}{:>14.4g}{:>12.3g}{:>12.3g}\n",
                        model.joint_names[static_cast<std::size_t>(line.joint)], line.steps,
                        line.slowest, line.fastest, line.shortest, line.longest);
  }
  text += limits_table(model, report.limits, report.shares, kProgrammeCheckRate);
  if (!report.found) return text + "\nno programme: " + report.message + "\n";
  return text +
         fmt::format("\none pass takes {:.4g} s; this file: {}\n", report.duration,
                     report.periods) +
         programme_advice(report) + "\n";
}

}  // namespace dyngen::runtime
