// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/diagnose/diagnosis_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "runtime/report/residual_charts.h"
#include "runtime/tools/dynid/page/page_parts.h"

namespace dyngen::runtime {
namespace {

using Eigen::VectorXd;
using Row = std::vector<ReportCell>;

std::string change_words(double before, double after) {
  if (!(before > 0) || !std::isfinite(after)) return "-";
  return fmt::format("{:+.1f} %", 100 * (after / before - 1));
}

/// What "before" is of.
std::string model_before(const DiagnosisReport& report) {
  return report.diagnosis.sessions.empty() ? "model alone" : "model of the reference";
}

ReportBars rms_bars(const DiagnosisReport& report) {
  const HeldoutResidual& rms = report.diagnosis.heldout;
  ReportBars bars;
  bars.id = "heldout-rms";
  bars.title = "Held-out residual, rms";
  bars.caption =
      "Recorded torque less the refitted model, less the model with the findings, and the noise of "
      "the fitted recordings. Held-out recordings may have more stiction, where friction can take "
      "any value. Each joint has its own scale.";
  for (int j = 0; j < report.joints(); ++j) {
    const auto& marked = report.arm.joints;
    const bool found = std::any_of(marked.begin(), marked.end(), [&](const ReportArm::Joint& own) {
      return own.marked && own.coordinate == j;
    });
    bars.groups.push_back({joint_words(j),
                           report.unit(j),
                           found,
                           {{model_before(report), Role::kBefore, entry_of(rms.before, j)},
                            {"with findings", Role::kAfter, entry_of(rms.after, j)},
                            {"noise", Role::kFloor, entry_of(rms.floor, j)}}});
  }
  return bars;
}

ReportSection first_section(const DiagnosisReport& report) {
  std::vector<ReportBlock> further;
  std::vector<std::string> lines;
  for (const Finding& own : report.diagnosis.findings) {
    lines.push_back(fmt::format("{} of {}, probability {:.2f}", own.effect.law.name,
                                answer_place(own.effect), own.probability));
  }
  for (const Unexplained& own : report.diagnosis.unexplained) {
    lines.push_back(fmt::format("structure without a name on {}, over {}", joint_words(own.joint),
                                fmt::join(own.variables, ", ")));
  }
  if (!lines.empty()) further.emplace_back(ReportList{lines});
  int fitted = 0, heldout = 0, reference = 0;
  double seconds = 0;
  for (const DiagnosedRecording& own : report.recordings) {
    (own.use == "fitted" ? fitted : own.use == "held out" ? heldout : reference) += 1;
    seconds += own.seconds;
  }
  if (fitted > 0) {
    further.emplace_back(ReportText{
        fmt::format(
            "{} recording{} fitted, {} held out{}, {:.1f} s in all.", fitted,
            fitted == 1 ? "" : "s", heldout > 0 ? fmt::format("{}", heldout) : "a fifth of each",
            reference > 0 ? fmt::format(", {} of the time before", reference) : "", seconds),
        ReportText::Tone::kQuiet});
  }
  return first_screen(
      "Verdict", sentence(report.diagnosis.sentence), std::move(further), report.arm,
      report.diagnosis.heldout.before.size() != 0 ? rms_bars(report) : ReportBars{});
}

void add_heldout(const DiagnosisReport& report, std::vector<ReportSection>& sections) {
  const HeldoutResidual& rms = report.diagnosis.heldout;
  if (rms.before.size() == 0) return;
  ReportTable table{{"", model_before(report), "with the findings", "noise", "", "change"}, {}, 0};
  for (int j = 0; j < report.joints(); ++j) {
    if (!std::isfinite(entry_of(rms.after, j))) continue;  // not judged
    table.rows.push_back({joint_words(j), entry_of(rms.before, j), entry_of(rms.after, j),
                          entry_of(rms.floor, j), report.unit(j),
                          change_words(entry_of(rms.before, j), entry_of(rms.after, j))});
  }
  ReportSection section =
      section_of("heldout", "Recordings that were not fitted", {std::move(table)});
  for (const std::string& remark : rms.remarks) {
    section.parts.front().blocks.emplace_back(ReportText{remark});
  }
  if (!report.views.heldout.empty()) {
    for (int j = 0; j < report.joints(); ++j) {
      if (!std::isfinite(entry_of(rms.after, j))) continue;  // not judged
      section.parts.front().blocks.emplace_back(
          proof_chart(report.views.heldout, j, entry_of(rms.floor, j), report.unit(j),
                      fmt::format("heldout-joint-{}", j + 1)));
    }
  }
  sections.push_back(std::move(section));
}

void add_unexplained(const DiagnosisReport& report, std::vector<ReportSection>& sections) {
  const auto& all = report.diagnosis.unexplained;
  if (all.empty()) return;
  ReportSection section{"unexplained", "Structure without a name", ReportSection::Kind::kPlain, {}};
  const AxisLabel label = [&](const std::string& name) { return variable_label(report, name); };
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Unexplained& own = all[i];
    ReportPart part{fmt::format("unexplained-{}", i + 1), "", joint_words(own.joint), {}};
    part.blocks.emplace_back(
        ReportFacts{{{"rms", fmt::format("{:.3g} {}", own.rms, report.unit(own.joint)), ""},
                     {"goes with", fmt::format("{}", fmt::join(own.variables, ", ")), ""}}});
    part.blocks.emplace_back(ReportText{sentence(own.description)});
    if (i < report.views.unexplained.size() && !report.views.unexplained[i].over.empty()) {
      part.blocks.emplace_back(where_chart(report.views.unexplained[i], {}, label,
                                           report.unit(own.joint),
                                           fmt::format("unexplained-{}-chart", i + 1)));
    }
    section.parts.push_back(std::move(part));
  }
  sections.push_back(std::move(section));
}

void add_forward(const DiagnosisReport& report, std::vector<ReportSection>& sections) {
  if (!report.forward) return;
  const ForwardComparison& forward = *report.forward;
  std::vector<ReportBlock> blocks = {ReportText{fmt::format(
      "Both models as robots in closed loop, {}, over {:.1f} s: simulated less recorded (rms). A "
      "stiff loop hides model errors in position and shows them in torque, a soft one the other "
      "way round.",
      forward.how, forward.seconds)}};
  for (const SimulatedError* error : {&forward.before, &forward.after}) {
    if (!error->why_not.empty()) blocks.emplace_back(ReportText{sentence(error->why_not)});
  }
  ReportTable table{{"", "", "model alone", "with the findings", "", "change"}, {}, 0};
  const auto add = [&](const char* what, const VectorXd& before, const VectorXd& after, int joint,
                       const std::string& unit) {
    if (before.size() == 0 && after.size() == 0) return;
    table.rows.push_back({joint_words(joint), what, entry_of(before, joint), entry_of(after, joint),
                          unit, change_words(entry_of(before, joint), entry_of(after, joint))});
  };
  for (int j = 0; j < report.joints(); ++j) {
    const bool revolute = report.revolute[static_cast<std::size_t>(j)];
    add("position", forward.before.position, forward.after.position, j, revolute ? "rad" : "m");
    add("torque", forward.before.torque, forward.after.torque, j, report.unit(j));
  }
  if (!table.rows.empty()) blocks.emplace_back(std::move(table));
  sections.push_back(section_of("simulated", "Simulated before and after", std::move(blocks)));
}

void add_not_judged(const Diagnosis& diagnosis, std::vector<ReportSection>& sections) {
  if (diagnosis.not_judged.empty()) return;
  ReportTable table{{"", "fitted equations", "needed", "why"}, {}, 0};
  for (const UnjudgedJoint& own : diagnosis.not_judged) {
    table.rows.push_back({joint_words(own.joint), own.equations, own.needed, own.why});
  }
  sections.push_back(section_of("not-judged", "Joints that are not judged", {std::move(table)}));
}

void add_undecidable(const Diagnosis& diagnosis, std::vector<ReportSection>& sections) {
  if (diagnosis.undecidable.empty()) return;
  ReportTable table{{"", "families", "why"}, {}, kRowsShown};
  for (const Undecidable& own : diagnosis.undecidable) {
    table.rows.push_back({own.joint < 0 ? "the whole robot" : joint_words(own.joint),
                          fmt::format("{}", fmt::join(own.families, ", ")), own.why});
  }
  sections.push_back(
      section_of("undecidable", "What these data cannot decide", {std::move(table)}));
}

/// Largest changes first, counted in standard deviations.
void add_base(const Diagnosis& diagnosis, std::vector<ReportSection>& sections) {
  if (diagnosis.base_parameters.empty()) return;
  const auto shift = [](const BaseShift& own) {
    return own.stddev > 0 ? std::abs(own.after - own.before) / own.stddev : 0;
  };
  std::vector<BaseShift> shifts = diagnosis.base_parameters;
  std::stable_sort(shifts.begin(), shifts.end(),
                   [&](const BaseShift& a, const BaseShift& b) { return shift(a) > shift(b); });
  ReportTable table{{"parameter", "before", "after", "std", "change in std"}, {}, kRowsShown};
  for (const BaseShift& own : shifts) {
    table.rows.push_back({own.name, own.before, own.after, own.stddev, shift(own)});
  }
  std::string title = "Parameters of the model",
              text = "Base parameters as fitted: nothing was found that they carried.";
  if (!diagnosis.findings.empty()) {
    title = "What the findings changed in the model";
    text = "Base parameters, those first that had been carrying most of what was left out.";
  }
  if (!diagnosis.sessions.empty()) {
    title = "Parameters of the reference and since then";
    text = "Base parameters, largest differences first. Between sessions: " + diagnosis.sessions;
  }
  sections.push_back(section_of("parameters", title, {ReportText{text}, std::move(table)}));
}

/// A line an effect, a column a joint.
void add_certificate(const DiagnosisReport& report, std::vector<ReportSection>& sections) {
  const Diagnosis& diagnosis = report.diagnosis;
  if (diagnosis.certificate.empty()) return;
  const auto columns = static_cast<std::size_t>(report.joints()) + 1;
  std::vector<std::pair<std::string, std::string>> order;
  std::map<std::pair<std::string, std::string>, std::vector<std::string>> cells;
  for (std::size_t i = 0; i < diagnosis.certificate.size(); ++i) {
    const CertificateLine& line = diagnosis.certificate[i];
    const EffectLaw& law = line.effect.law;
    std::string size;
    if (line.parameter >= 0) {
      size = law.parameters[static_cast<std::size_t>(line.parameter)].name;
      const std::string& unit = report.certificate_units[i];
      if (!unit.empty() && unit != "1") size += ", " + unit;
    }
    const std::pair<std::string, std::string> key(law.name, size);
    const auto [found, added] = cells.try_emplace(key, std::vector<std::string>(columns));
    if (added) order.push_back(key);
    std::string& cell = found->second[static_cast<std::size_t>(answer_joint(line.effect))];
    if (!cell.empty()) cell += "; ";
    cell += std::isfinite(line.smallest) ? fmt::format("{:.3g}", line.smallest) : "never";
    if (line.effect.other >= 0) cell += fmt::format(" with {}", line.effect.other + 1);
  }
  ReportTable table{{"effect", "size"}, {}, kRowsShown};
  for (int j = 0; j < report.joints(); ++j) table.header.push_back(joint_words(j));
  table.header.emplace_back("whole robot");
  for (const auto& key : order) {
    Row row = {key.first, key.second};
    const std::vector<std::string>& own = cells.at(key);
    for (std::size_t j = 1; j < columns; ++j) row.emplace_back(own[j]);
    row.emplace_back(own[0]);
    table.rows.push_back(std::move(row));
  }
  sections.push_back(
      section_of("certificate", "What was not found, and how large it would have had to be",
                 {ReportText{fmt::format("The smallest size that is found nine times in ten on "
                                         "such recordings: lambda of {:.0f}, "
                                         "by as many tests as were made.",
                                         diagnosis.detectable_lambda)},
                  std::move(table)}));
}

void add_structure(const Diagnosis& diagnosis, std::vector<ReportSection>& sections) {
  ReportTable table{{"", "what is left by", "statistic", "threshold", "", "strongest in"}, {}, 0};
  const auto add = [&](const std::vector<StructureTest>& tests, const char* when) {
    for (const StructureTest& test : tests) {
      table.rows.push_back(
          {joint_words(test.joint), when, test.statistic, test.threshold,
           test.statistic > test.threshold ? "structure" : "nothing above the noise",
           test.variable});
    }
  };
  add(diagnosis.before, "the model alone");
  add(diagnosis.after, "with the findings");
  if (table.rows.empty()) return;
  sections.push_back(section_of("structure", "Is there structure?", {std::move(table)}));
}

void add_noise(const DiagnosisReport& report, std::vector<ReportSection>& sections) {
  const NoiseFloor& noise = report.diagnosis.noise;
  if (noise.how.empty()) return;
  std::vector<ReportBlock> blocks = {ReportText{sentence(noise.how)}};
  ReportTable table{{"", "deviation", "", "samples worth one", "independent samples"}, {}, 0};
  for (int j = 0; j < report.joints() && j < noise.deviation.size(); ++j) {
    if (!std::isfinite(noise.deviation[j])) continue;  // not judged
    table.rows.push_back({joint_words(j), noise.deviation[j], report.unit(j),
                          entry_of(noise.correlation_time, j), entry_of(noise.worth, j)});
  }
  if (!table.rows.empty()) blocks.emplace_back(std::move(table));
  sections.push_back(section_of("noise", "Noise floor", std::move(blocks)));
}

void add_cut_off(const Diagnosis& diagnosis, std::vector<ReportSection>& sections) {
  const EffortUsed& effort = diagnosis.effort;
  std::vector<ReportBlock> blocks;
  if (!effort.cut_off.empty()) {
    blocks.emplace_back(ReportText{fmt::format(
        "The search ended at an effort of {:.3g}; the limit is {:.3g}. It cut off:", effort.done,
        effort.most)});
    blocks.emplace_back(ReportList{effort.cut_off});
  }
  if (!effort.not_offered.empty()) {
    blocks.emplace_back(ReportText{"Effects that are slower than the recordings were not tried:"});
    blocks.emplace_back(ReportList{effort.not_offered});
  }
  if (blocks.empty()) return;
  sections.push_back(section_of("not-searched", "Not searched", std::move(blocks)));
}

void add_condition(const DiagnosisReport& report, std::vector<ReportSection>& sections) {
  ReportSection section{
      "condition", "Condition of the recordings", ReportSection::Kind::kPlain, {}};
  ReportTable table{{"file", "use", "length [s]"}, {}, 0};
  for (const DiagnosedRecording& own : report.recordings) {
    table.rows.push_back({own.name, own.use, own.seconds});
  }
  if (!table.rows.empty()) section.parts.push_back({"", "", "", {std::move(table)}});
  for (const ConditionLine& line : report.diagnosis.condition) {
    section.parts.push_back({"", "", line.recording, {ReportList{line.sentences}}});
  }
  if (!report.notes.empty()) {
    section.parts.push_back({"", "", report.robot_path, {ReportList{report.notes}}});
  }
  if (!section.parts.empty()) sections.push_back(std::move(section));
}

void add_next(const DiagnosisReport& report, std::vector<ReportSection>& sections) {
  const NextExperiment& next = report.diagnosis.next;
  if (next.purpose.empty()) return;
  std::vector<ReportBlock> blocks = {ReportText{"To " + next.purpose + "."}};
  if (!next.archetype.empty()) blocks.emplace_back(ReportText{"Motion: " + next.archetype + "."});
  blocks.emplace_back(ReportText{report.json_path.empty()
                                     ? "A trajectory of it, with the file of --json:"
                                     : "A trajectory of it:"});
  blocks.emplace_back(ReportCode{next_command(report)});
  if (!report.trajectory.empty())
    blocks.emplace_back(ReportText{"Trajectory: " + report.trajectory});
  sections.push_back(section_of("next-experiment", "Next experiment", std::move(blocks)));
}

std::string origin_words(const DiagnosisReport& report) {
  return fmt::format("dynid {}, seed {}, at most {:.3g} % false alarms of the whole diagnosis{}.",
                     report.version, report.seed, 100 * report.false_alarm,
                     report.residual_only
                         ? "; torque is what another simulator leaves, and the model's parameters "
                           "were not fitted"
                         : "");
}

}  // namespace

ReportDocument diagnosis_document(const DiagnosisReport& report) {
  const Diagnosis& diagnosis = report.diagnosis;
  ReportDocument document;
  document.kind = "diagnosis";
  document.title = report.robot;
  document.subtitle = "Model and recordings compared by dynid diagnose";
  document.state = verdict_name(diagnosis.verdict);
  document.state_text = document.state;
  std::replace(document.state_text.begin(), document.state_text.end(), '_', ' ');
  document.origin = origin_words(report);
  document.sections.push_back(first_section(report));
  for (const bool uncertain : {false, true}) {
    for (std::size_t i = 0; i < diagnosis.findings.size(); ++i) {
      if (diagnosis.findings[i].uncertain != uncertain) continue;
      document.sections.push_back(finding_section(report, i));
    }
  }
  add_unexplained(report, document.sections);
  add_heldout(report, document.sections);
  add_forward(report, document.sections);
  if (report.two_encoders.any()) {
    document.sections.push_back(two_encoders_section(report.two_encoders));
  }
  if (report.ripples.any()) document.sections.push_back(ripple_section(report.ripples));
  if (report.steady.any()) document.sections.push_back(steady_section(report.steady));
  add_next(report, document.sections);
  add_certificate(report, document.sections);
  add_not_judged(diagnosis, document.sections);
  add_undecidable(diagnosis, document.sections);
  add_cut_off(diagnosis, document.sections);
  add_base(diagnosis, document.sections);
  add_structure(diagnosis, document.sections);
  add_condition(report, document.sections);
  add_noise(report, document.sections);
  document.sections.push_back(origin_section(report.command, origin_words(report)));
  return document;
}

}  // namespace dyngen::runtime
