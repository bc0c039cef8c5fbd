// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/effects/effect_report.h"

#include <fmt/format.h>

#include <cmath>

#include "gen/effect_file/units.h"
#include "runtime/tools/dynid/robot/joint_words.h"

namespace dyngen::runtime {

using Eigen::Index;

int file_joint(const RobotModel& model, int coordinate) {
  for (int j = 1; j <= model.size(); ++j) {
    if (coordinate >= 0 && model.joint(j).coordinate == coordinate) return j;
  }
  return 0;
}

int file_joint(const EffectInstance& effect, const RobotModel& model) {
  return effect.link > 0 ? effect.link : file_joint(model, effect.joint);
}

std::string state_of(const EffectParameterFit& parameter) {
  if (parameter.held) return "held";
  if (!parameter.seen) return "not seen";
  return parameter.at_bound ? "at its bound" : "";
}

std::vector<std::vector<std::string>> effect_units(const std::vector<EffectInstance>& effects,
                                                   const EffectCatalogue& catalogue,
                                                   const LinearModel& model) {
  std::vector<std::vector<std::string>> units;
  for (const EffectInstance& effect : effects) {
    const bool revolute =
        effect.joint < 0 || model.revolute[static_cast<std::size_t>(effect.joint)];
    units.emplace_back();
    for (const auto& parameter : catalogue.find(effect.law.name)->parameters) {
      units.back().push_back(
          unit_text(parameter.unit, revolute ? JointUnits::kRevolute : JointUnits::kPrismatic));
    }
  }
  return units;
}

std::string place_of(const EffectInstance& effect, const RobotModel& model) {
  const int joint = file_joint(effect, model);
  if (joint == 0) return "";
  if (effect.other < 0) return joint_words(model, joint);
  return fmt::format("joint {}, other {}", joint, file_joint(model, effect.other));
}

std::string effect_rows(const EffectReport& report, const DescribedRobot& robot) {
  std::string text = fmt::format("\n{:<30}{:>12}{:>11}  {:<14}{:<14}{}\n", "effects", "value",
                                 "stddev", "unit", "", "what it is");
  for (std::size_t k = 0; k < report.fit.parameters.size(); ++k) {
    const EffectInstance& effect = report.fit.point.effects[k];
    const std::string place = place_of(effect, robot.model);
    text += fmt::format("{}{}{}\n", effect.law.name, place.empty() ? "" : " of ", place);
    for (std::size_t p = 0; p < report.fit.parameters[k].size(); ++p) {
      const EffectParameterFit& parameter = report.fit.parameters[k][p];
      const EffectParameter& described = effect.law.parameters[p];
      const bool known = !parameter.held && parameter.seen && parameter.stddev > 0;
      std::string line =
          fmt::format("  {:<28}{:>12.5g}{:>11}  {:<14}{:<14}{}", described.name, parameter.value,
                      known ? fmt::format("{:.3g}", parameter.stddev) : "-", report.units[k][p],
                      state_of(parameter), described.meaning);
      while (line.back() == ' ') line.pop_back();
      text += line + "\n";
    }
  }
  for (const EffectRemark& remark : report.fit.remarks) text += "  " + remark.text + "\n";
  const bool heldout = report.heldout_rms.size() != 0;
  text += fmt::format("\n{:<13}{:>16}{:>10}", "residual rms", "without effects", "with them");
  if (heldout) text += fmt::format("{:>27}{:>10}", "held-out, without effects", "with them");
  text += "\n";
  for (Index j = 0; j < report.fit.rms.size(); ++j) {
    text += fmt::format("{:<13}{:>16.4g}{:>10.4g}", fmt::format("joint {}", j + 1),
                        report.fit.rms_without[j], report.fit.rms[j]);
    if (heldout) {
      text +=
          fmt::format("{:>27.4g}{:>10.4g}", report.heldout_rms_without[j], report.heldout_rms[j]);
    }
    text += fmt::format(" {}\n", robot.linear.revolute[static_cast<std::size_t>(j)] ? "N m" : "N");
  }
  return text;
}

std::string effect_row(const EffectInstance& effect, const RobotModel& model) {
  std::string row = "effect " + effect.law.name;
  if (const int joint = file_joint(effect, model); joint > 0)
    row += fmt::format(" joint={}", joint);
  if (effect.other >= 0) row += fmt::format(" other={}", file_joint(model, effect.other));
  for (std::size_t p = 0; p < effect.law.parameters.size(); ++p) {
    const double value = effect.parameters[static_cast<Index>(p)];
    row += fmt::format(" {}={}", effect.law.parameters[p].name,
                       std::isfinite(value) ? fmt::format("{}", value) : "*");
  }
  return row;
}

std::vector<std::string> effect_file_rows(const EffectReport& report, const DescribedRobot& robot) {
  std::vector<std::string> rows;
  for (const EffectInstance& effect : report.fit.point.effects) {
    rows.push_back(effect_row(effect, robot.model));
  }
  return rows;
}

std::vector<std::string> effect_comment(const EffectReport& report) {
  std::vector<std::string> comment = {"effects: value +- standard deviation:"};
  for (std::size_t k = 0; k < report.fit.parameters.size(); ++k) {
    const EffectInstance& effect = report.fit.point.effects[k];
    for (std::size_t p = 0; p < report.fit.parameters[k].size(); ++p) {
      const EffectParameterFit& parameter = report.fit.parameters[k][p];
      const bool known = !parameter.held && parameter.seen && parameter.stddev > 0;
      std::string line =
          fmt::format("  {:<32} {:>13.6g} {:<13} {:<9} {}",
                      fmt::format("{} {}", effect.law.name, effect.law.parameters[p].name),
                      parameter.value, known ? fmt::format("+- {:.3g}", parameter.stddev) : "",
                      report.units[k][p], state_of(parameter));
      while (line.back() == ' ') line.pop_back();
      comment.push_back(std::move(line));
    }
  }
  comment.emplace_back("");
  return comment;
}

}  // namespace dyngen::runtime
