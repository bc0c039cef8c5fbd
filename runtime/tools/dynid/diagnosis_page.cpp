// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "runtime/tools/dynid/diagnosis_report.h"
#include "runtime/tools/dynid/html.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Row = std::vector<HtmlCell>;

HtmlCell word(const std::string& text) { return HtmlCell::text(text); }

std::string heading(const std::string& text) { return "<h2>" + html_text(text) + "</h2>\n"; }
std::string small_heading(const std::string& text) { return "<h3>" + html_text(text) + "</h3>\n"; }

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() || unit == "1" ? text : text + " " + unit;
}

/// With a capital and a full stop.
std::string sentence(std::string text) {
  if (text.empty()) return text;
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  if (text.back() != '.') text += '.';
  return text;
}

std::string verdict_section(const DiagnosisReport& report) {
  std::string text =
      fmt::format("<h1>{}</h1>\n<p class=\"quiet\">{}</p>\n", html_text(report.robot),
                  "Model and recordings compared by dynid diagnose");
  text += "<p class=\"verdict\">" + html_text(sentence(report.diagnosis.sentence)) + "</p>\n";
  return text;
}

double entry(const VectorXd& values, int joint) {
  return joint < values.size() ? values[joint] : std::numeric_limits<double>::quiet_NaN();
}

std::string heldout_section(const DiagnosisReport& report) {
  const HeldoutResidual& rms = report.diagnosis.heldout;
  if (rms.before.size() == 0) return {};
  std::string text = heading("Recordings that were not fitted");
  text += html_paragraph(
      "What the model leaves of the recorded torque (rms): the model alone, fitted; with the "
      "findings; and the noise, below which no model comes.");
  text +=
      "<p class=\"quiet\"><span class=\"key\" style=\"background: var(--before)\"></span>model "
      "alone<span class=\"key\" style=\"background: var(--after)\"></span>with the findings<span "
      "class=\"key\" style=\"background: var(--floor)\"></span>noise</p>\n";
  std::vector<Row> rows;
  for (int j = 0; j < report.joints(); ++j) {
    const double before = entry(rms.before, j), after = entry(rms.after, j),
                 floor = entry(rms.floor, j);
    const double most = std::max({before, after, floor, 1e-300});
    const std::string label = fmt::format("joint {}: {:.3g} without, {:.3g} with, noise {:.3g}",
                                          j + 1, before, after, floor);
    rows.push_back(
        {word(fmt::format("joint {}", j + 1)),
         {html_bars({{before / most, "before"}, {after / most, "after"}, {floor / most, "floor"}},
                    label)},
         HtmlCell::of(before),
         HtmlCell::of(after),
         HtmlCell::of(floor),
         word(report.unit(j)),
         {before > 0 && std::isfinite(after) ? fmt::format("{:+.1f} %", 100 * (after / before - 1))
                                             : "-",
          true}});
  }
  return text +
         html_table({"", "", "model alone", "with the findings", "noise", "", "change"}, rows);
}

std::string forward_section(const DiagnosisReport& report) {
  if (!report.forward) return {};
  const ForwardComparison& forward = *report.forward;
  std::string text = heading("Simulated before and after");
  text += html_paragraph(fmt::format(
      "Both models as robots in closed loop, {}, over {:.1f} s: simulated less recorded (rms). A "
      "stiff loop hides model errors in position and shows them in torque, a soft one the other "
      "way round.",
      forward.how, forward.seconds));
  for (const SimulatedError* error : {&forward.before, &forward.after}) {
    if (!error->why_not.empty()) text += html_paragraph(sentence(error->why_not));
  }
  std::vector<Row> rows;
  const auto add = [&](const char* what, const VectorXd& before, const VectorXd& after, int joint,
                       const std::string& unit) {
    if (before.size() == 0 && after.size() == 0) return;
    const double first = entry(before, joint), second = entry(after, joint);
    rows.push_back(
        {word(fmt::format("joint {}", joint + 1)),
         word(what),
         HtmlCell::of(first),
         HtmlCell::of(second),
         word(unit),
         {first > 0 && std::isfinite(second) ? fmt::format("{:+.1f} %", 100 * (second / first - 1))
                                             : "-",
          true}});
  };
  for (int j = 0; j < report.joints(); ++j) {
    const bool revolute = report.revolute[static_cast<std::size_t>(j)];
    add("position", forward.before.position, forward.after.position, j, revolute ? "rad" : "m");
    add("torque", forward.before.torque, forward.after.torque, j, report.unit(j));
  }
  if (rows.empty()) return text;
  return text + html_table({"", "", "model alone", "with the findings", "", "change"}, rows);
}

std::string where_sentence(const DiagnosisReport& report, const Finding& finding) {
  const Whereabouts& where = finding.where;
  std::string text = "It acts on " + answer_place(finding.effect);
  if (!where.variable.empty()) {
    text += fmt::format(
        ", at {} from {:.3g} to {}", where.variable, where.from,
        with_unit(fmt::format("{:.3g}", where.to), variable_unit(where.variable, report.revolute)));
  }
  if (std::isfinite(where.t_from) && std::isfinite(where.t_to)) {
    text += fmt::format(", between {:.4g} and {:.4g} s", where.t_from, where.t_to);
    if (!where.recording.empty()) text += " of " + where.recording;
  }
  text += ".";
  if (where.share > 0) {
    text +=
        fmt::format(" There lies {:.0f} % of what the model alone leaves of the joint's torque.",
                    100 * where.share);
  }
  return text;
}

std::string tests_of(const Finding& finding) {
  if (finding.tests.empty()) return {};
  std::string text = small_heading("Tests of the name") + "<ul>\n";
  for (const FalsifierOutcome& test : finding.tests) {
    const char* outcome = !test.known ? "open" : test.passed ? "passed" : "failed";
    text += fmt::format("<li><span class=\"{}\">{}</span> <code>{}</code>{}</li>\n",
                        test.known ? outcome : "quiet", outcome, html_text(test.test),
                        test.text.empty() ? "" : ": " + html_text(test.text));
  }
  return text + "</ul>\n";
}

std::string finding_section(const DiagnosisReport& report, std::size_t place) {
  const Diagnosis& diagnosis = report.diagnosis;
  const Finding& finding = diagnosis.findings[place];
  const EffectWords& words = report.words[place];
  const EffectLaw& law = finding.effect.law;
  std::string text = fmt::format("<div class=\"finding\">\n<h2>{}. {} of {}</h2>\n", place + 1,
                                 html_text(law.name), html_text(answer_place(finding.effect)));
  text += html_paragraph(words.title + " (family " + law.family + ").");
  text += html_paragraph(sentence(finding.why));
  text += small_heading("Where") + html_paragraph(where_sentence(report, finding));
  text += small_heading("How much") + "<pre>";
  for (const std::string& line : words.equations) text += html_text(line) + "\n";
  text += "</pre>\n";
  std::vector<Row> rows;
  for (std::size_t p = 0; p < finding.parameters.size(); ++p) {
    const EffectParameterFit& parameter = finding.parameters[p];
    const bool known = !parameter.held && parameter.seen && parameter.stddev > 0;
    const double half = diagnosis.fit.interval * parameter.stddev;
    rows.push_back(
        {{"<code>" + html_text(law.parameters[p].name) + "</code>"},
         HtmlCell::of(parameter.value),
         {known ? fmt::format("{:.4g} to {:.4g}", parameter.value - half, parameter.value + half)
          : parameter.held     ? "held"
          : !parameter.seen    ? "not seen"
          : parameter.at_bound ? "at its bound"
                               : "-",
          true},
         word(words.units[p]),
         word(words.meanings[p])});
  }
  text += html_table({"", "value", "95 % interval", "unit", ""}, rows);
  text += small_heading("How sure");
  text += html_paragraph(fmt::format(
      "Probability of the name: {:.2f}. {}", finding.probability,
      finding.aliases.size() < 2 ? "These recordings tell it from every other family."
                                 : fmt::format("These recordings cannot tell these apart: {}.",
                                               fmt::join(finding.aliases, ", "))));
  text += html_table(
      {"evidence", "", ""},
      {{word("lambda"), HtmlCell::of(finding.evidence.lambda),
        word("noncentrality of what a refit of the model does not take up; some 28 are found nine "
             "times in ten")},
       {word("change of BIC"), HtmlCell::of(finding.evidence.delta_bic),
        word("of adding it, with the samples that the noise is worth; negative is better")},
       {word("held-out gain"),
        {fmt::format("{:.1f} %", 100 * finding.evidence.heldout_gain), true},
        word("by which it lowers the rms of its joints on recordings that were not fitted")},
       {word("absorbed"),
        {fmt::format("{:.1f} %", 100 * finding.absorbed), true},
        word("of its squares were hidden in the model's own parameters")}});
  return text + tests_of(finding) + "</div>\n";
}

std::string undecidable_section(const Diagnosis& diagnosis) {
  if (diagnosis.undecidable.empty()) return {};
  std::vector<Row> rows;
  for (const Undecidable& own : diagnosis.undecidable) {
    rows.push_back(
        {word(own.joint < 0 ? "the whole robot" : fmt::format("joint {}", own.joint + 1)),
         word(fmt::format("{}", fmt::join(own.families, ", "))), word(own.why)});
  }
  return heading("What these data cannot decide") + html_table({"", "families", "why"}, rows);
}

std::string unexplained_section(const DiagnosisReport& report) {
  if (report.diagnosis.unexplained.empty()) return {};
  std::vector<Row> rows;
  for (const Unexplained& own : report.diagnosis.unexplained) {
    rows.push_back({word(fmt::format("joint {}", own.joint + 1)), HtmlCell::of(own.rms),
                    word(report.unit(own.joint)),
                    word(fmt::format("{}", fmt::join(own.variables, ", "))),
                    word(own.description)});
  }
  return heading("Structure without a name") +
         html_table({"", "rms", "", "over", "what it looks like"}, rows);
}

/// Largest changes first, counted in standard deviations.
std::string base_section(const Diagnosis& diagnosis) {
  if (diagnosis.base_parameters.empty()) return {};
  const auto shift = [](const BaseShift& own) {
    return own.stddev > 0 ? std::abs(own.after - own.before) / own.stddev : 0;
  };
  std::vector<BaseShift> shifts = diagnosis.base_parameters;
  std::stable_sort(shifts.begin(), shifts.end(),
                   [&](const BaseShift& a, const BaseShift& b) { return shift(a) > shift(b); });
  std::vector<Row> rows;
  for (const BaseShift& own : shifts) {
    rows.push_back({word(own.name), HtmlCell::of(own.before), HtmlCell::of(own.after),
                    HtmlCell::of(own.stddev), HtmlCell::of(shift(own))});
  }
  return heading("What the findings changed in the model") +
         html_paragraph("Base parameters that had been carrying what was left out.") +
         html_table({"", "before", "after", "std", "change in std"}, rows);
}

/// A line an effect, a column a joint.
std::string certificate_section(const DiagnosisReport& report) {
  const Diagnosis& diagnosis = report.diagnosis;
  if (diagnosis.certificate.empty()) return {};
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
  std::vector<std::string> header = {"effect", "size"};
  for (int j = 1; j <= report.joints(); ++j) header.push_back(fmt::format("joint {}", j));
  header.emplace_back("whole robot");
  std::vector<Row> rows;
  for (const auto& key : order) {
    Row row = {word(key.first), word(key.second)};
    const std::vector<std::string>& own = cells.at(key);
    for (std::size_t j = 1; j < columns; ++j) row.push_back(word(own[j]));
    row.push_back(word(own[0]));
    rows.push_back(std::move(row));
  }
  return heading("What was not found, and how large it would have had to be") +
         html_paragraph("The smallest size that is found nine times in ten on such recordings.") +
         html_table(header, rows);
}

std::string noise_section(const DiagnosisReport& report) {
  const NoiseFloor& noise = report.diagnosis.noise;
  std::string text = heading("Noise");
  text += html_paragraph(sentence(noise.how));
  std::vector<Row> rows;
  for (int j = 0; j < report.joints() && j < noise.deviation.size(); ++j) {
    rows.push_back({word(fmt::format("joint {}", j + 1)), HtmlCell::of(noise.deviation[j]),
                    word(report.unit(j)), HtmlCell::of(entry(noise.correlation_time, j)),
                    HtmlCell::of(entry(noise.worth, j))});
  }
  if (!rows.empty()) {
    text += html_table({"", "deviation", "", "samples worth one", "independent samples"}, rows);
  }
  return text;
}

std::string structure_section(const Diagnosis& diagnosis) {
  std::vector<Row> rows;
  const auto add = [&](const std::vector<StructureTest>& tests, const char* when) {
    for (const StructureTest& test : tests) {
      rows.push_back(
          {word(fmt::format("joint {}", test.joint + 1)), word(when), HtmlCell::of(test.statistic),
           HtmlCell::of(test.threshold),
           word(test.statistic > test.threshold ? "structure" : "nothing above the noise"),
           word(test.variable)});
    }
  };
  add(diagnosis.before, "the model alone");
  add(diagnosis.after, "with the findings");
  if (rows.empty()) return {};
  return heading("Is there structure?") +
         html_table({"", "what is left by", "statistic", "threshold", "", "strongest in"}, rows);
}

std::string condition_section(const DiagnosisReport& report) {
  std::string text = heading("Recordings");
  std::vector<Row> rows;
  for (const DiagnosedRecording& own : report.recordings) {
    rows.push_back({word(own.name), word(own.use), {fmt::format("{:.1f} s", own.seconds), true}});
  }
  if (!rows.empty()) text += html_table({"file", "use", "length"}, rows);
  for (const ConditionLine& line : report.diagnosis.condition) {
    text += small_heading(line.recording) + html_list(line.sentences);
  }
  return text;
}

std::string next_section(const DiagnosisReport& report) {
  const NextExperiment& next = report.diagnosis.next;
  if (next.purpose.empty()) return {};
  std::string text = heading("Next experiment") + html_paragraph("To " + next.purpose + ".");
  if (!next.archetype.empty()) text += html_paragraph("Motion: " + next.archetype + ".");
  text += html_paragraph(report.json_path.empty() ? "A trajectory of it, with the file of --json:"
                                                  : "A trajectory of it:") +
          "<pre>" + html_text(next_command(report)) + "</pre>\n";
  if (!report.trajectory.empty()) text += html_paragraph("Trajectory: " + report.trajectory);
  return text;
}

std::string origin_section(const DiagnosisReport& report) {
  std::string text =
      heading("How this was made") + "<pre>" + html_text(report.command) + "</pre>\n";
  text += html_paragraph(
      fmt::format("dynid {}, seed {}, at most {:.3g} % false alarms of the whole "
                  "diagnosis{}.",
                  report.version, report.seed, 100 * report.false_alarm,
                  report.residual_only ? "; torque is what another simulator leaves, and the "
                                         "model's parameters were not fitted"
                                       : ""));
  return text;
}

}  // namespace

std::string diagnosis_page(const DiagnosisReport& report) {
  const Diagnosis& diagnosis = report.diagnosis;
  std::string body = verdict_section(report) + heldout_section(report) + forward_section(report);
  for (std::size_t i = 0; i < diagnosis.findings.size(); ++i) body += finding_section(report, i);
  body += unexplained_section(report) + undecidable_section(diagnosis) + next_section(report) +
          base_section(diagnosis) + structure_section(diagnosis) + noise_section(report) +
          certificate_section(report) + condition_section(report) + origin_section(report);
  return html_page(report.robot + ": diagnosis", body);
}

}  // namespace dyngen::runtime
