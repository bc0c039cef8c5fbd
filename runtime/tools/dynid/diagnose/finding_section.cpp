// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "runtime/report/residual_charts.h"
#include "runtime/tools/dynid/diagnose/diagnosis_document.h"
#include "runtime/tools/dynid/page/page_parts.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t kChangesShown = 8;

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit.empty() || unit == "1" ? text : text + " " + unit;
}

std::string percent(double part) { return fmt::format("{:.0f} %", 100 * part); }

/// Writes the parts of one finding.
class FindingWriter {
 public:
  FindingWriter(const DiagnosisReport& report, std::size_t place)
      : report_(report),
        place_(place),
        finding_(report.diagnosis.findings[place]),
        words_(report.words[place]),
        view_(place < report.views.findings.size() ? &report.views.findings[place] : nullptr),
        joint_(view_ != nullptr ? view_->joint : std::max(0, finding_.effect.joint)) {}

  ReportSection section() {
    ReportSection section;
    section.id = fmt::format("finding-{}", place_ + 1);
    section.kind = ReportSection::Kind::kFinding;
    section.title = fmt::format("{}. {}{}", place_ + 1, finding_.uncertain ? "Uncertain: " : "",
                                finding_.effect.law.name);
    section.title += " of " + answer_place(finding_.effect);
    section.parts = {where(), what(), how_much(), model(), proof(), changed(), next()};
    return section;
  }

 private:
  [[nodiscard]] std::string id(const std::string& word) const {
    return fmt::format("finding-{}-{}", place_ + 1, word);
  }
  [[nodiscard]] AxisLabel label() const {
    return [this](const std::string& variable) { return variable_label(report_, variable); };
  }
  [[nodiscard]] bool drawn() const { return view_ != nullptr && !view_->over.empty(); }

  ReportPart where() const {
    const EffectLocation& where = finding_.where;
    std::string text = "It acts on " + answer_place(finding_.effect);
    if (!where.variable.empty()) {
      text += fmt::format(", at {} from {:.3g} to {}", where.variable, where.from,
                          with_unit(fmt::format("{:.3g}", where.to),
                                    variable_unit(where.variable, report_.revolute)));
    }
    if (std::isfinite(where.t_from) && std::isfinite(where.t_to)) {
      text += fmt::format(", between {:.4g} and {:.4g} s", where.t_from, where.t_to);
      if (!where.recording.empty()) text += " of " + where.recording;
    }
    text += ".";
    if (where.share > 0) {
      text += fmt::format(
          " That is {:.0f} % of what the model alone leaves of the joint's torque above the noise.",
          100 * where.share);
    }
    ReportPart part{id("where"), "Where", "", {ReportText{text}}};
    if (drawn()) {
      part.blocks.emplace_back(
          where_chart(*view_, where, label(), report_.unit(joint_), id("where-chart")));
    }
    return part;
  }

  ReportPart what() const {
    const EffectLaw& law = finding_.effect.law;
    ReportPart part{id("what"), "What", sentence(words_.title), {}};
    const std::string alike = others();
    part.blocks.emplace_back(
        ReportFacts{{{"family", law.family, ""},
                     {"probability of the name", fmt::format("{:.2f}", finding_.probability), ""},
                     {"cannot be told from", alike.empty() ? "nothing" : alike,
                      alike.empty() ? "these recordings tell it from every other family"
                                    : "by these recordings"}}});
    if (!words_.equations.empty()) part.blocks.emplace_back(ReportFormula{words_.equations});
    part.blocks.emplace_back(ReportText{sentence(finding_.why)});
    if (!finding_.tests.empty()) {
      ReportTable tests{{"test of the name", "outcome", ""}, {}, 0};
      for (const FalsifierOutcome& test : finding_.tests) {
        tests.rows.push_back({test.test,
                              !test.known   ? "open"
                              : test.passed ? "passed"
                                            : "failed",
                              test.text});
      }
      part.blocks.emplace_back(std::move(tests));
    }
    return part;
  }

  [[nodiscard]] std::string others() const {
    std::vector<std::string> names;
    for (const std::string& family : finding_.aliases) {
      if (family != finding_.effect.law.family) names.push_back(family);
    }
    if (!finding_.elsewhere.empty()) names.push_back(finding_.elsewhere);
    if (!finding_.unnamed.empty()) names.push_back(finding_.unnamed);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  ReportPart how_much() const {
    ReportPart part{id("much"), "How much", "", {}};
    ReportFacts facts;
    const std::string unit = report_.unit(joint_);
    if (drawn()) {
      facts.items.push_back({"size, rms", fmt::format("{:.3g} {}", view_->size, unit),
                             fmt::format("{} of the joint's torque",
                                         percent(view_->size / std::max(view_->torque, 1e-300)))});
      facts.items.push_back({"largest", fmt::format("{:.3g} {}", view_->peak, unit), ""});
    }
    const HeldoutResidual& rms = report_.diagnosis.heldout;
    const double before = entry_of(rms.before, joint_), after = entry_of(rms.after, joint_),
                 floor =
                     std::isfinite(entry_of(rms.floor, joint_)) ? entry_of(rms.floor, joint_) : 0;
    if (before > floor && std::isfinite(after)) {
      const double gap = before * before - floor * floor;
      const double left = std::max(0.0, after * after - floor * floor);
      facts.items.push_back(
          {"share of the gap", percent(std::clamp(1 - left / gap, 0.0, 1.0)),
           fmt::format("of joint {}'s held-out variance above the noise, closed by all findings",
                       joint_ + 1)});
    }
    facts.items.push_back({"held-out gain", percent(finding_.evidence.heldout_gain),
                           "by which it lowers the rms of its joints on recordings not fitted"});
    part.blocks.emplace_back(std::move(facts));
    part.blocks.emplace_back(
        ReportTable{{"evidence", "", ""},
                    {{"lambda", finding_.evidence.lambda,
                      fmt::format("chi-square reduction beside the refitted model; one of {:.0f} "
                                  "is found with probability 0.9",
                                  report_.diagnosis.detectable_lambda)},
                     {"change of BIC", finding_.evidence.delta_bic,
                      "with the effective number of samples; negative is better"},
                     {"absorbed", fmt::format("{:.1f} %", 100 * finding_.absorbed),
                      "of its chi-square is absorbed by the model's own parameters"}},
                    0});
    return part;
  }

  ReportPart model() const {
    const EffectLaw& law = finding_.effect.law;
    ReportPart part{id("model"), "Model", "", {}};
    if (drawn()) {
      part.blocks.emplace_back(
          model_chart(*view_, label(), report_.unit(joint_), id("model-chart")));
    }
    ReportTable table{{"parameter", "value", "95 % interval", "unit", ""}, {}, 0};
    for (std::size_t p = 0; p < finding_.parameters.size(); ++p) {
      const EffectParameterFit& parameter = finding_.parameters[p];
      const std::string why = why_no_interval(finding_, p);
      const double half = report_.diagnosis.fit.interval * parameter.stddev;
      table.rows.push_back({law.parameters[p].name, parameter.value,
                            !why.empty() ? why
                                         : fmt::format("{:.4g} to {:.4g}", parameter.value - half,
                                                       parameter.value + half),
                            words_.units[p], words_.meanings[p]});
    }
    part.blocks.emplace_back(std::move(table));
    if (!words_.code.empty()) {
      part.blocks.emplace_back(
          ReportText{"What dyngen writes for it in C, of the improved robot file:"});
      part.blocks.emplace_back(ReportCode{words_.code});
    } else if (!words_.why_no_code.empty()) {
      part.blocks.emplace_back(ReportText{
          sentence("dyngen writes no C for it: " + words_.why_no_code), ReportText::Tone::kQuiet});
    }
    return part;
  }

  ReportPart proof() const {
    ReportPart part{id("proof"), "Proof", "Recordings that were not fitted", {}};
    const HeldoutResidual& rms = report_.diagnosis.heldout;
    const double before = entry_of(rms.before, joint_), after = entry_of(rms.after, joint_);
    if (finding_.since_reference) {
      part.blocks.emplace_back(ReportText{fmt::format(
          "A change since the reference. With the parameters of the reference, {:.3g} {} rms of the "
          "held-out torque of joint {} is left; with those fitted since then, {:.3g} {}.",
          before, report_.unit(joint_), joint_ + 1, after, report_.unit(joint_))});
      if (!report_.views.heldout.empty() && std::isfinite(after)) {
        ReportChart chart = proof_chart({}, joint_, NAN, "", id("proof-chart"));
        chart.same_as = fmt::format("heldout-joint-{}", joint_ + 1);
        part.blocks.emplace_back(std::move(chart));
      }
      return part;
    }
    if (std::isfinite(before) && std::isfinite(after)) {
      part.blocks.emplace_back(ReportText{fmt::format(
          "The residual of joint {} falls from {:.3g} to {:.3g} {} rms ({:+.1f} %); the noise is "
          "{}.",
          joint_ + 1, before, after, report_.unit(joint_), 100 * (after / before - 1),
          std::isfinite(entry_of(rms.floor, joint_))
              ? fmt::format("{:.3g}", entry_of(rms.floor, joint_))
              : "not known")});
    }
    if (!report_.views.heldout.empty()) {
      ReportChart chart = proof_chart({}, joint_, NAN, "", id("proof-chart"));
      chart.same_as = fmt::format("heldout-joint-{}", joint_ + 1);
      part.blocks.emplace_back(std::move(chart));
    }
    return part;
  }

  /// Parameters of the links that the joint bears, largest changes first.
  ReportPart changed() const {
    ReportPart part{id("changed"), "What changed", "", {}};
    struct Change {
      const BaseShift* shift;
      double deviations;
    };
    std::vector<Change> changes;
    const auto& all = report_.diagnosis.base_parameters;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool own = finding_.effect.link == 0 || i >= report_.parameter_links.size() ||
                       report_.parameter_links[i] == finding_.effect.link;
      const double size =
          all[i].stddev > 0 ? std::abs(all[i].after - all[i].before) / all[i].stddev : 0;
      if (own && size > 1) changes.push_back({&all[i], size});
    }
    std::stable_sort(changes.begin(), changes.end(),
                     [](const Change& a, const Change& b) { return a.deviations > b.deviations; });
    if (changes.size() > kChangesShown) changes.resize(kChangesShown);
    if (changes.empty()) {
      part.blocks.emplace_back(ReportText{
          "No parameter of its link moved by more than its own deviation: the model had not been "
          "carrying it."});
      return part;
    }
    part.blocks.emplace_back(
        ReportText{finding_.since_reference
                       ? "Parameters of its link, of the reference and since then:"
                       : "Parameters of its link that had been carrying what was left out:"});
    ReportTable table{{"parameter", "before", "after", "std", "change in std"}, {}, 0};
    for (const Change& own : changes) {
      table.rows.push_back({own.shift->name, own.shift->before, own.shift->after, own.shift->stddev,
                            own.deviations});
    }
    part.blocks.emplace_back(std::move(table));
    return part;
  }

  ReportPart next() const {
    ReportPart part{id("next"), "What next", "", {}};
    const NextExperiment& next = report_.diagnosis.next;
    const auto& families = next.families;
    const bool about =
        !next.purpose.empty() && next.joint == finding_.effect.joint &&
        std::find(families.begin(), families.end(), finding_.effect.law.family) != families.end();
    if (about) {
      part.blocks.emplace_back(
          ReportText{fmt::format("To {}{}. A trajectory of it:", next.purpose,
                                 next.archetype.empty() ? "" : ": " + next.archetype)});
      part.blocks.emplace_back(ReportCode{next_command(report_)});
    }
    std::vector<std::string> open;
    for (const FalsifierOutcome& test : finding_.tests) {
      if (!test.known) open.push_back(test.test + (test.text.empty() ? "" : ": " + test.text));
    }
    if (!open.empty()) {
      part.blocks.emplace_back(ReportText{"Tests of the name that these recordings leave open:"});
      part.blocks.emplace_back(ReportList{open});
    }
    if (part.blocks.empty()) {
      part.blocks.emplace_back(ReportText{"Nothing about it is open."});
    }
    return part;
  }

  const DiagnosisReport& report_;
  std::size_t place_;
  const Finding& finding_;
  const EffectWords& words_;
  const ResidualView* view_;
  int joint_;
};

}  // namespace

ReportSection finding_section(const DiagnosisReport& report, std::size_t place) {
  return FindingWriter(report, place).section();
}

std::string variable_label(const DiagnosisReport& report, const std::string& variable) {
  const std::size_t digits = variable.find_first_of("0123456789");
  const std::string stem = variable.substr(0, digits);
  const std::string joint =
      digits == std::string::npos ? "" : " of joint " + variable.substr(digits);
  if (stem == "phase") return fmt::format("phase of a ripple's period{} [rad]", joint);
  const char* words = stem == "q"          ? "position"
                      : stem == "qd"       ? "velocity"
                      : stem == "qdd"      ? "acceleration"
                      : stem == "tau_load" ? "load torque"
                      : stem == "distance" ? "distance since reversal"
                      : stem == "t"        ? "time"
                                           : nullptr;
  const std::string unit = stem == "t" ? "s" : variable_unit(variable, report.revolute);
  return fmt::format("{}{}{}", words == nullptr ? stem : words, joint,
                     unit.empty() ? "" : " [" + unit + "]");
}

}  // namespace dyngen::runtime
