// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "runtime/tools/dynid/diagnose/diagnosis_report.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr std::size_t kMostLines = 3;   // of what is listed besides findings
constexpr std::size_t kMostShapes = 2;  // findings with a small plot

std::string where_text(const DiagnosisReport& report, const EffectLocation& where) {
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
    text += fmt::format(" ({:.0f} % of what the model leaves there)", 100 * where.share);
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
    numbers.push_back(fmt::format("{} = {}{}", finding.effect.law.parameters[p].name,
                                  parameter_text(finding, p, report.diagnosis.fit.interval),
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
  if (!finding.elsewhere.empty()) others.push_back(finding.elsewhere);
  if (!finding.unnamed.empty()) others.push_back(finding.unnamed);
  if (!others.empty()) text += fmt::format("; or {}", fmt::join(others, ", "));
  for (const std::string& value : finding.unusual) text += "; " + value;
  for (const std::string& sentence : finding.caveats) text += "; " + sentence;
  return text + "\n";
}

/// A line of small letters under a finding: what the model alone leaves over the variable in which
/// that collapses, one for each direction of the joint.
std::string shape_lines(const DiagnosisReport& report, std::size_t place, const TextStyle& style) {
  if (place >= report.views.findings.size() || report.views.findings[place].over.empty()) return {};
  const CoordinateView& over = report.views.findings[place].over.front();
  if (over.x.size() < 2) return {};
  std::string text;
  for (const DirectionView& own : over.directions) {
    constexpr int kWidth = 48;  // characters: the axis is uniform, bins are not
    std::vector<double> shown(kWidth, NAN);
    const double first = over.x[0], length = over.x[over.x.size() - 1] - first;
    for (Index b = 0; b < over.x.size(); ++b) {
      const auto column =
          std::min<Index>(kWidth - 1, static_cast<Index>(kWidth * (over.x[b] - first) / length));
      if (std::isfinite(own.left[b])) shown[static_cast<std::size_t>(column)] = own.left[b];
    }
    const double least = own.left.array().isFinite().select(own.left, INFINITY).minCoeff();
    const double most = own.left.array().isFinite().select(own.left, -INFINITY).maxCoeff();
    if (!(most >= least)) continue;
    const char* way = own.direction > 0 ? "forward" : own.direction < 0 ? "backward" : "";
    text += fmt::format("     {:<9}{}  {:.2g} .. {:.2g} {} over {}\n", way,
                        coloured(sparkline(shown, style), TextColour::kBefore, style), least, most,
                        report.unit(report.views.findings[place].joint), over.variable);
  }
  return text;
}

/// A line a joint: a bar of what is left after, in that of before, and the numbers.
std::string heldout_table(const DiagnosisReport& report, const TextStyle& style) {
  const HeldoutResidual& rms = report.diagnosis.heldout;
  if (rms.before.size() == 0) return {};
  constexpr int kWidth = 20;
  std::string text = fmt::format("{:<13}{:<22}{:>12}{:>19}{:>9}\n", "held-out rms", "",
                                 report.diagnosis.sessions.empty() ? "model alone" : "reference",
                                 "with the findings", "noise");
  const auto number = [](double value) {
    return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("-");
  };
  for (int j = 0; j < report.joints(); ++j) {
    const double before = rms.before[j], after = rms.after[j], floor = rms.floor[j];
    if (!std::isfinite(after)) {
      text += fmt::format("  {:<11}not judged\n", fmt::format("joint {}", j + 1));
      continue;
    }
    const double most = std::max({before, after, std::isfinite(floor) ? floor : 0, 1e-300});
    text += fmt::format("  {:<11}{}|{:>12}{:>19}{:>9} {}\n", fmt::format("joint {}", j + 1),
                        coloured(text_bar(after / most, kWidth, style), TextColour::kAfter, style),
                        number(before), number(after), number(floor), report.unit(j));
  }
  for (const std::string& remark : rms.remarks) text += "  " + remark + "\n";
  return text;
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
    for (const double value : values) text += fmt::format("{:>8}", fmt::format("{:.3g}", value));
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

/// Joints that move, but too little; those that stand are in the sentence of the verdict.
std::vector<std::string> not_judged_lines(const Diagnosis& diagnosis) {
  std::vector<std::string> lines;
  for (const UnjudgedJoint& own : diagnosis.not_judged) {
    if (own.equations > 0) lines.push_back(own.why);
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

std::string diagnosis_text(const DiagnosisReport& report, const TextStyle& style) {
  const Diagnosis& diagnosis = report.diagnosis;
  std::string text =
      coloured(fmt::format("{}: {}", report.robot, diagnosis.sentence), TextColour::kMark, style) +
      "\n";
  if (!report.joint_legend.empty()) text += "  " + report.joint_legend + "\n";
  for (const bool uncertain : {false, true}) {
    bool first = true;
    for (std::size_t i = 0; i < diagnosis.findings.size(); ++i) {
      if (diagnosis.findings[i].uncertain != uncertain) continue;
      if (uncertain && first) text += "uncertain, and not counted as an explanation:\n";
      first = false;
      text += finding_line(report, i);
      if (i < kMostShapes) text += shape_lines(report, i, style);
    }
  }
  text += heldout_table(report, style) + forward_table(report);
  text += two_encoders_text(report.two_encoders) + ripple_text(report.ripples);
  text += steady_text(report.steady);
  if (!diagnosis.noise.how.empty()) text += "noise: " + diagnosis.noise.how + "\n";
  if (!diagnosis.sessions.empty()) text += "sessions: " + diagnosis.sessions + "\n";
  if (diagnosis.effort.most > 0) {
    text += fmt::format("effort: {:.3g} of {:.3g}\n", diagnosis.effort.done, diagnosis.effort.most);
  }
  text += list_text("not searched:", diagnosis.effort.not_searched());
  for (const std::string& note : report.notes) text += note + "\n";
  text += list_text("not judged:", not_judged_lines(diagnosis));
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
