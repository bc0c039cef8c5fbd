// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/diagnose/diagnosis_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "gen/effect_file/effect_variables.h"
#include "gen/effect_file/units.h"
#include "runtime/tools/dynid/effects/effect_code_text.h"
#include "runtime/tools/dynid/effects/effect_formula.h"
#include "runtime/tools/dynid/effects/effect_report.h"
#include "runtime/tools/dynid/robot/joint_words.h"

namespace dyngen::runtime {
namespace {

EffectWords words_of(const EffectInstance& effect, const EffectCatalogue& catalogue,
                     const LinearModel& model) {
  EffectWords words;
  if (catalogue.find(effect.law.name) == nullptr) {  // a change of the model's own parameters
    words.title = effect.law.title;
    for (const EffectParameter& parameter : effect.law.parameters) {
      words.units.push_back(parameter.unit);
      words.meanings.push_back(parameter.meaning);
    }
    words.why_no_code = "it is a change of the model's own parameters, which the file has";
    return words;
  }
  const EffectFile& file = *catalogue.find(effect.law.name);
  words.title = file.title;
  words.formula = effect_formula(file);
  words.equations = equation_lines(file);
  words.units = effect_units({effect}, catalogue, model).front();
  for (const auto& parameter : file.parameters) words.meanings.push_back(parameter.meaning);
  words.plot = file.plot;
  words.why_no_code = why_no_code(effect, catalogue);
  return words;
}

}  // namespace

std::string DiagnosisReport::unit(int joint) const {
  return revolute[static_cast<std::size_t>(joint)] ? "N m" : "N";
}

DiagnosisReport diagnosis_report(Diagnosis diagnosis, const DescribedRobot& robot,
                                 const EffectCatalogue& catalogue) {
  DiagnosisReport report;
  report.robot = robot.linear.name;
  report.joint_legend = joint_legend(robot.model);
  report.revolute = robot.linear.revolute;
  for (const Finding& finding : diagnosis.findings) {
    report.words.push_back(words_of(finding.effect, catalogue, robot.linear));
  }
  for (const CertificateLine& line : diagnosis.certificate) {
    const auto units = effect_units({line.effect}, catalogue, robot.linear).front();
    report.certificate_units.push_back(
        line.parameter < 0 ? "" : units[static_cast<std::size_t>(line.parameter)]);
  }
  for (const LinearParameter& parameter : robot.linear.parameters) {
    report.parameter_links.push_back(parameter.link);
  }
  report.diagnosis = std::move(diagnosis);
  return report;
}

std::vector<int> marked_joints(const Diagnosis& diagnosis) {
  std::vector<int> joints;
  const auto add = [&](int joint) {
    if (joint >= 0 && std::find(joints.begin(), joints.end(), joint) == joints.end()) {
      joints.push_back(joint);
    }
  };
  for (const Finding& finding : diagnosis.findings) {
    add(finding.effect.joint);
    add(finding.effect.other);
  }
  for (const Unexplained& unexplained : diagnosis.unexplained) add(unexplained.joint);
  return joints;
}

std::string verdict_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kClean:
      return "clean";
    case Verdict::kExplained:
      return "explained";
    case Verdict::kNotExplained:
      return "not_explained";
    case Verdict::kUnexplainedStructure:
      return "unexplained_structure";
    case Verdict::kInsufficientData:
      break;
  }
  return "insufficient_data";
}

int answer_joint(const EffectInstance& effect) { return effect.joint + 1; }

std::string next_command(const DiagnosisReport& report) {
  return fmt::format("dynid excite {} --for {} -o trajectory.csv",
                     report.robot_path.empty() ? "ROBOT" : report.robot_path,
                     report.json_path.empty() ? "FINDINGS.json" : report.json_path);
}

std::string answer_place(const EffectInstance& effect) {
  if (effect.joint < 0) return "the whole robot";
  if (effect.other < 0) return fmt::format("joint {}", effect.joint + 1);
  return fmt::format("joint {} with joint {}", effect.joint + 1, effect.other + 1);
}

std::string variable_unit(const std::string& variable, const std::vector<bool>& revolute) {
  std::size_t digits = variable.size();
  while (digits > 0 && std::isdigit(static_cast<unsigned char>(variable[digits - 1])) != 0) {
    --digits;
  }
  const std::string stem = variable.substr(0, digits);
  const int joint = std::atoi(variable.substr(digits).c_str()) - 1;
  const bool turns = joint < 0 || joint >= static_cast<int>(revolute.size()) ||
                     revolute[static_cast<std::size_t>(joint)];
  if (stem == "distance") return turns ? "rad" : "m";
  const ::dyngen::EffectVariable* known = find_effect_variable(stem);
  if (known == nullptr) return {};
  return unit_text(known->unit, turns ? JointUnits::kRevolute : JointUnits::kPrismatic);
}

std::string why_no_interval(const Finding& finding, std::size_t place) {
  const EffectParameterFit& parameter = finding.parameters[place];
  if (parameter.held) {
    const bool scanned = finding.effect.law.parameters[place].role == EffectRole::kScanned;
    return scanned ? "scanned" : "held";
  }
  if (!parameter.seen) return "not seen";
  if (parameter.at_bound) return "at its bound";
  return parameter.stddev > 0 ? "" : "not known";
}

std::string parameter_text(const Finding& finding, std::size_t place, double interval) {
  const EffectParameterFit& parameter = finding.parameters[place];
  const std::string value = fmt::format("{:.4g}", parameter.value);
  std::string why = why_no_interval(finding, place);
  if (!std::isfinite(parameter.value)) return why;
  if (!why.empty()) return fmt::format("{} ({})", value, why);
  return fmt::format("{} +- {:.2g}", value, interval * parameter.stddev);
}

}  // namespace dyngen::runtime
