// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "runtime/tools/dynid/diagnosis_report.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr std::size_t kMostLines = 5;  // of what is listed besides findings

std::string where_text(const DiagnosisReport& report, const Whereabouts& where) {
  std::string text;
  if (!where.variable.empty()) {
    const std::string unit = variable_unit(where.variable, report.revolute);
    text = fmt::format("{} {:.3g} .. {:.3g}{}", where.variable, where.from, where.to,
                       unit.empty() || unit == "1" ? "" : " " + unit);
  }
  if (std::isfinite(where.t_from) && std::isfinite(where.t_to)) {
    text +=
        fmt::format("{}t {:.3g} .. {:.3g} s", text.empty() ? "" : ", ", where.t_from, where.t_to);
    if (!where.recording.empty()) text += " of " + where.recording;
  }
  if (!text.empty() && where.share > 0) {
    text += fmt::format(" ({:.0f} % of what the model leaves)", 100 * where.share);
  }
  return text;
}

std::string finding_line(const DiagnosisReport& report, std::size_t place) {
  const Finding& finding = report.diagnosis.findings[place];
  const EffectWords& words = report.words[place];
  std::string text =
      fmt::format("  {}. {} of {}, probability {:.2f}", place + 1, finding.effect.law.name,
                  answer_place(finding.effect), finding.probability);
  const std::string where = where_text(report, finding.where);
  if (!where.empty()) text += "; at " + where;
  std::vector<std::string> numbers;
  for (std::size_t p = 0; p < finding.parameters.size(); ++p) {
    const std::string& unit = words.units[p];
    numbers.push_back(
        fmt::format("{} = {}{}", finding.effect.law.parameters[p].name,
                    parameter_text(finding.parameters[p], report.diagnosis.fit.interval),
                    unit == "1" ? "" : " " + unit));
  }
  if (!numbers.empty()) text += fmt::format("; {}", fmt::join(numbers, ", "));
  if (finding.evidence.heldout_gain > 0) {
    text += fmt::format("; held-out rms {:.0f} % lower", 100 * finding.evidence.heldout_gain);
  }
  std::vector<std::string> failed;
  for (const FalsifierOutcome& test : finding.tests) {
    if (test.known && !test.passed) failed.push_back(test.test);
  }
  if (!failed.empty()) text += fmt::format("; fails {}", fmt::join(failed, ", "));
  std::vector<std::string> others;
  for (const std::string& family : finding.aliases) {
    if (family != finding.effect.law.family) others.push_back(family);
  }
  if (!others.empty()) text += fmt::format("; or {}", fmt::join(others, ", "));
  return text + "\n";
}

std::string heldout_table(const DiagnosisReport& report) {
  const HeldoutResidual& rms = report.diagnosis.heldout;
  if (rms.before.size() == 0) return {};
  std::string text = fmt::format("{:<20}", "held-out rms");
  for (int j = 0; j < report.joints(); ++j) {
    text += fmt::format("{:>10}", fmt::format("{} {}", j + 1, report.unit(j)));
  }
  const auto row = [&](const char* name, const Eigen::VectorXd& values) {
    text += fmt::format("\n  {:<18}", name);
    for (const double value : values) {
      text += fmt::format("{:>10}", std::isfinite(value) ? fmt::format("{:.4g}", value) : "-");
    }
  };
  row("model alone", rms.before);
  row("with the findings", rms.after);
  row("floor of the noise", rms.floor);
  return text + "\n";
}

/// A row a candidate and quantity, a column a joint.
std::string forward_table(const DiagnosisReport& report) {
  if (!report.forward) return {};
  const ForwardComparison& forward = *report.forward;
  std::string text = fmt::format("simulated: {}; rms of simulated less recorded\n", forward.how);
  for (const SimulatedError* error : {&forward.before, &forward.after}) {
    if (!error->why_not.empty()) text += "  " + error->why_not + "\n";
  }
  const auto row = [&](const char* name, const Eigen::VectorXd& values) {
    if (values.size() == 0) return;
    text += fmt::format("  {:<18}", name);
    for (const double value : values) text += fmt::format("{:>10}", fmt::format("{:.3g}", value));
    text += "\n";
  };
  row("position, alone", forward.before.position);
  row("position, findings", forward.after.position);
  row("torque, alone", forward.before.torque);
  row("torque, findings", forward.after.torque);
  return text;
}

/// Lines of a list, the first ones only.
std::string list_text(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string text = title + "\n";
  for (std::size_t i = 0; i < lines.size() && i < kMostLines; ++i) text += "  " + lines[i] + "\n";
  if (lines.size() > kMostLines) {
    text += fmt::format("  and {} more, which the report lists\n", lines.size() - kMostLines);
  }
  return text;
}

/// "joints 1, 3": -1 stands for the whole robot.
std::string joints_text(const std::vector<int>& joints) {
  if (joints.front() < 0) return "the whole robot";
  std::vector<int> numbers;
  for (const int joint : joints) numbers.push_back(joint + 1);
  return fmt::format("joint{} {}", numbers.size() == 1 ? "" : "s", fmt::join(numbers, ", "));
}

/// A line for what is undecidable for the same reason, its joints together.
std::vector<std::string> undecidable_lines(const Diagnosis& diagnosis) {
  std::vector<std::pair<const Undecidable*, std::vector<int>>> groups;
  for (const Undecidable& own : diagnosis.undecidable) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& group) {
      return group.first->families == own.families && group.first->why == own.why &&
             (group.first->joint < 0) == (own.joint < 0);
    });
    if (same != groups.end()) {
      same->second.push_back(own.joint);
    } else {
      groups.push_back({&own, {own.joint}});
    }
  }
  std::vector<std::string> lines;
  for (const auto& [own, joints] : groups) {
    lines.push_back(
        fmt::format("{} of {}: {}", fmt::join(own->families, ", "), joints_text(joints), own->why));
  }
  return lines;
}

std::vector<std::string> unexplained_lines(const DiagnosisReport& report) {
  std::vector<std::string> lines;
  for (const Unexplained& own : report.diagnosis.unexplained) {
    lines.push_back(fmt::format("joint {}: {:.3g} {} over {}: {}", own.joint + 1, own.rms,
                                report.unit(own.joint), fmt::join(own.variables, ", "),
                                own.description));
  }
  return lines;
}

}  // namespace

std::string diagnosis_text(const DiagnosisReport& report) {
  const Diagnosis& diagnosis = report.diagnosis;
  std::string text = fmt::format("{}: {}\n", report.robot, diagnosis.sentence);
  for (std::size_t i = 0; i < diagnosis.findings.size(); ++i) text += finding_line(report, i);
  text += heldout_table(report) + forward_table(report);
  if (!diagnosis.noise.how.empty()) text += "noise: " + diagnosis.noise.how + "\n";
  text += list_text("unexplained:", unexplained_lines(report));
  text += list_text("cannot be decided:", undecidable_lines(diagnosis));
  if (!diagnosis.next.purpose.empty()) {
    text += fmt::format("next: {}{}\n", diagnosis.next.purpose,
                        diagnosis.next.archetype.empty() ? "" : ", by " + diagnosis.next.archetype);
    text += fmt::format("  a trajectory of it{}: {}\n",
                        report.json_path.empty() ? ", with the file of --json" : "",
                        next_command(report));
  }
  if (!diagnosis.certificate.empty()) {
    const auto found = [](const CertificateLine& line) { return std::isfinite(line.smallest); };
    text += fmt::format(
        "not found: {} effects, {} of which would have been seen if large enough\n",
        diagnosis.certificate.size(),
        std::count_if(diagnosis.certificate.begin(), diagnosis.certificate.end(), found));
  }
  if (!report.written.empty())
    text += fmt::format("written: {}\n", fmt::join(report.written, ", "));
  return text;
}

}  // namespace dyngen::runtime
