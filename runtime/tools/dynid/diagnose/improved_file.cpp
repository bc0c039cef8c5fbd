// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/diagnose/improved_file.h"

#include <fmt/format.h>

#include "runtime/tools/dynid/effects/effect_report.h"
#include "runtime/tools/dynid/robot/identified_file.h"

namespace dyngen::runtime {

std::vector<std::string> findings_comment(const DiagnosisReport& report,
                                          const DescribedRobot& robot) {
  const Diagnosis& diagnosis = report.diagnosis;
  std::vector<std::string> comment = {"", "by dynid diagnose: " + diagnosis.sentence};
  for (std::size_t i = 0; i < diagnosis.findings.size(); ++i) {
    const Finding& finding = diagnosis.findings[i];
    const std::string place = place_of(finding.effect, robot.model);
    comment.push_back(fmt::format("  {}{}: probability {:.2f}", finding.effect.law.name,
                                  place.empty() ? "" : " of " + place, finding.probability));
    for (std::size_t p = 0; p < finding.parameters.size(); ++p) {
      const std::string& unit = report.words[i].units[p];
      comment.push_back(fmt::format("    {} = {}{}", finding.effect.law.parameters[p].name,
                                    parameter_text(finding, p, diagnosis.fit.interval),
                                    unit == "1" ? "" : " " + unit));
    }
  }
  const std::vector<std::string> ripples = ripple_comment(report.ripples);
  comment.insert(comment.end(), ripples.begin(), ripples.end());
  if (!diagnosis.findings.empty() || !ripples.empty()) {
    comment.emplace_back("(+-: intervals of 95 %)");
  }
  comment.emplace_back("");
  return comment;
}

std::string improved_text(const DiagnosisReport& report, const DescribedRobot& robot) {
  const EffectPoint& point = report.diagnosis.fit.point;
  std::vector<std::string> rows;
  for (const EffectInstance& effect : point.effects) {
    if (effect.recording >= 0) continue;  // an event of that recording is none of the robot
    rows.push_back(effect_row(effect, robot.model));
  }
  for (const EffectInstance& effect : report.ripple_effects) {
    rows.push_back(effect_row(effect, robot.model));
  }
  std::vector<std::string> comment = findings_comment(report, robot);
  if (report.residual_only) {
    std::vector<std::string> lines;
    for (const std::string& line : comment) lines.push_back(line.empty() ? "#" : "# " + line);
    lines.insert(lines.end(), rows.begin(), rows.end());
    return text_with_rows(robot.file, lines);
  }
  return identified_text(robot, nearest_standard(robot, point.beta), {comment, {}, rows});
}

}  // namespace dyngen::runtime
