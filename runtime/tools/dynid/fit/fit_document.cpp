// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "runtime/estimation/covariance.h"
#include "runtime/tools/dynid/fit/fit_report.h"
#include "runtime/tools/dynid/fit/torque_charts.h"
#include "runtime/tools/dynid/page/arm_drawing.h"
#include "runtime/tools/dynid/page/page_parts.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Row = std::vector<ReportCell>;

std::string method_name(const MethodFit& fit) {
  return std::string(fit_method_names()[static_cast<std::size_t>(fit.method)]);
}

const LinearParameter& parameter_of(const FitReport& report, int place) {
  return report.robot.linear.parameters[static_cast<std::size_t>(place)];
}

int count_of(const FitReport& report, Seen state) {
  int count = 0;
  for (int i = 0; i < report.robot.linear.size(); ++i) count += seen(report, i) == state ? 1 : 0;
  return count;
}

std::string percent_words(double percent) {
  return percent < 10 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent);
}

/// Without joints that have no equations; 0 if none has.
VectorXd known_of(const VectorXd& values) {
  std::vector<double> known;
  for (const double value : values) {
    if (std::isfinite(value)) known.push_back(value);
  }
  if (known.empty()) known.push_back(0);
  return Eigen::Map<const VectorXd>(known.data(), static_cast<Index>(known.size()));
}

std::string sentence_of(const FitReport& report) {
  const MethodFit& fit = report.main();
  const bool heldout = fit.heldout_percent.size() != 0;
  const VectorXd percent = known_of(heldout ? fit.heldout_percent : fit.percent);
  const int weak = count_of(report, Seen::kWeak), unseen = count_of(report, Seen::kNo);
  const int size = report.robot.linear.size();
  std::string text = fmt::format(
      "{} fitted by {}; of the torque {}, {} to {} % is left, by joint",
      size > 0 ? fmt::format("{} base parameters", size) : "effects beside held numbers",
      method_name(fit), heldout ? "of recordings that were not fitted" : "that was fitted",
      percent_words(percent.minCoeff()), percent_words(percent.maxCoeff()));
  if (unseen > 0) text += fmt::format("; the data do not determine {}", unseen);
  if (weak > 0) {
    text += fmt::format("{} {} cannot be told from zero", unseen > 0 ? " and" : ";", weak);
  }
  return sentence(text);
}

/// Torque and residual; with effects, without them and with them.
ReportBars rms_bars(const FitReport& report) {
  const MethodFit& fit = report.main();
  const bool heldout = fit.heldout_rms.size() != 0;
  ReportBars bars;
  bars.id = "rms";
  bars.title = "Torque, and what the model leaves of it, rms";
  bars.caption = "Each joint has its own scale.";
  if (report.effects) {
    bars.caption += " The model without effects was fitted to the same equations.";
  }
  for (int j = 0; j < report.robot.linear.joints(); ++j) {
    ReportBarGroup group{joint_words(j), torque_unit(report.robot.linear, j), false, {}};
    const double rms = entry_of(fit.estimate.residual_rms, j), percent = entry_of(fit.percent, j);
    group.bars.push_back({"torque", Role::kData, percent > 0 ? 100 * rms / percent : NAN});
    if (report.effects) {
      const EffectReport& effects = *report.effects;
      group.bars.push_back(
          {"left without effects", Role::kBefore,
           entry_of(heldout ? effects.heldout_rms_without : effects.fit.rms_without, j)});
    }
    group.bars.push_back({"left, fitted", Role::kForward, rms});
    if (heldout)
      group.bars.push_back({"left, held out", Role::kModel, entry_of(fit.heldout_rms, j)});
    bars.groups.push_back(std::move(group));
  }
  return bars;
}

ReportSection first_section(const FitReport& report) {
  std::vector<ReportBlock> further;
  const auto heldout = std::count_if(report.recordings.begin(), report.recordings.end(),
                                     [](const RecordingLine& line) { return line.heldout; });
  const RecordingSummary& summary = report.data.summary;
  further.emplace_back(ReportText{
      fmt::format("{} recording{} fitted, {:.1f} s, {:.0f} equations a joint; {} held out.",
                  summary.recordings, summary.recordings == 1 ? "" : "s", summary.seconds(),
                  summary.equations.samples(), heldout),
      ReportText::Tone::kQuiet});
  if (!report.notes.empty()) further.emplace_back(ReportList{report.notes});
  const MotionExtent& extent = summary.extent;
  ReportArm arm;
  if (extent.lowest.size() == report.robot.linear.joints()) {
    arm = arm_drawing(report.robot.model, 0.5 * (extent.lowest + extent.highest), {});
  }
  return first_screen("Result", sentence_of(report), std::move(further), std::move(arm),
                      rms_bars(report));
}

ReportSection parameter_section(const FitReport& report) {
  const MethodFit& fit = report.main();
  const bool known = fit.estimate.covariance.size() != 0;
  constexpr std::size_t kParametersShown = 20;
  ReportTable table{
      {"parameter", "value", "std", "% of value", "unit", "seen"}, {}, kParametersShown};
  if (report.consistent) {
    table.header.insert(table.header.end(), {"consistent", "pull [std]"});
  }
  table.header.emplace_back("what it is");
  for (int i = 0; i < report.robot.linear.size(); ++i) {
    const LinearParameter& own = parameter_of(report, i);
    const double value = fit.estimate.beta[i];
    const Seen state = seen(report, i);
    const double std = known && state != Seen::kNo ? std::sqrt(fit.estimate.covariance(i, i)) : NAN;
    Row row = {own.name, value,
               std,      value != 0 ? 100 * std / std::abs(value) : NAN,
               own.unit, std::string(seen_name(state))};
    if (report.consistent) {
      row.emplace_back(report.consistent->beta[i]);
      row.emplace_back(report.consistent->pull[i]);
    }
    row.emplace_back(own.formula);
    table.rows.push_back(std::move(row));
  }
  const std::string words =
      known ? fmt::format(
                  "Standard deviations are for noise that is correlated as the residual is; an "
                  "interval of 95 % is the value and {:.3g} deviations. Weak: it holds zero.",
                  fit.interval)
            : "This method has no standard deviations.";
  return section_of("parameters", "Parameters", {ReportText{words}, std::move(table)});
}

void add_effects(const FitReport& report, std::vector<ReportSection>& sections) {
  if (!report.effects) return;
  const EffectReport& effects = *report.effects;
  ReportTable table{{"effect", "", "parameter", "value", "std", "unit", "", "what it is"}, {}, 0};
  for (std::size_t k = 0; k < effects.fit.parameters.size(); ++k) {
    const EffectInstance& effect = effects.fit.point.effects[k];
    for (std::size_t p = 0; p < effects.fit.parameters[k].size(); ++p) {
      const EffectParameterFit& own = effects.fit.parameters[k][p];
      const EffectParameter& described = effect.law.parameters[p];
      const bool known = !own.held && own.seen && own.stddev > 0;
      table.rows.push_back({p == 0 ? effect.law.name : "",
                            p == 0 ? place_of(effect, report.robot.model) : "", described.name,
                            own.value, known ? own.stddev : NAN, effects.units[k][p], state_of(own),
                            described.meaning});
    }
  }
  std::vector<ReportBlock> blocks = {std::move(table)};
  std::vector<std::string> remarks;
  for (const EffectRemark& remark : effects.fit.remarks) remarks.push_back(remark.text);
  if (!remarks.empty()) blocks.emplace_back(ReportList{std::move(remarks)});
  sections.push_back(section_of("effects", "Effects", std::move(blocks)));
}

void add_torque(const FitReport& report, std::vector<ReportSection>& sections) {
  const MethodFit& fit = report.main();
  const bool heldout = fit.heldout_rms.size() != 0;
  ReportTable table{{"", "equations", "rms", "% of torque"}, {}, 0};
  if (heldout) table.header.insert(table.header.end(), {"held out, rms", "% of torque"});
  table.header.insert(table.header.end(), {"", "correlated over [s]"});
  const VectorXd times = report.data.summary.noise.correlation_time();
  for (int j = 0; j < report.robot.linear.joints(); ++j) {
    Row row = {
        joint_words(j),
        static_cast<double>(report.data.summary.equations.joints[static_cast<std::size_t>(j)].rows),
        fit.estimate.residual_rms[j], fit.percent[j]};
    if (heldout) {
      row.emplace_back(fit.heldout_rms[j]);
      row.emplace_back(fit.heldout_percent[j]);
    }
    row.emplace_back(torque_unit(report.robot.linear, j));
    row.emplace_back(std::max(1.0, entry_of(times, j)) * report.data.summary.row_time);
    table.rows.push_back(std::move(row));
  }
  ReportSection section = section_of("torque", "Torque and residual", {std::move(table)});
  for (ReportChart& chart : torque_charts(report)) {
    section.parts.front().blocks.emplace_back(std::move(chart));
  }
  sections.push_back(std::move(section));
}

void add_together(const FitReport& report, std::vector<ReportSection>& sections) {
  if (report.together.empty()) return;
  ReportTable table{{"sum", "value", "standard deviation", "unit"}, {}, kRowsShown};
  for (const SeenCombination& own : report.together) {
    table.rows.push_back({own.text, own.value, own.stddev, own.unit});
  }
  sections.push_back(
      section_of("together", "What these recordings determine as sums alone", {std::move(table)}));
}

void add_unseen(const FitReport& report, std::vector<ReportSection>& sections) {
  if (report.unseen.empty()) return;
  ReportTable table{{"combination", "the motion that would show it"}, {}, kRowsShown};
  for (const UnseenCombination& own : report.unseen) table.rows.push_back({own.text, own.advice});
  sections.push_back(
      section_of("unseen", "What these recordings do not determine", {std::move(table)}));
}

std::string names_of(const FitReport& report, const std::vector<int>& places) {
  std::vector<std::string> names;
  for (const int place : places) names.push_back(parameter_of(report, place).name);
  return fmt::format("{}", fmt::join(names, " "));
}

void add_consistent(const FitReport& report, std::vector<ReportSection>& sections) {
  if (!report.consistent) return;
  const ConsistentFit& fit = *report.consistent;
  ReportTable table{{"% of torque left", "free", "consistent"}, {}, 0};
  const bool heldout = fit.heldout_percent.size() != 0;
  if (heldout) table.header.insert(table.header.end(), {"free, held out", "consistent, held out"});
  for (int j = 0; j < report.robot.linear.joints(); ++j) {
    Row row = {joint_words(j), report.main().percent[j], entry_of(fit.percent, j)};
    if (heldout) {
      row.emplace_back(entry_of(report.main().heldout_percent, j));
      row.emplace_back(entry_of(fit.heldout_percent, j));
    }
    table.rows.push_back(std::move(row));
  }
  std::vector<int> pulling;
  for (Index i = 0; i < fit.pull.size(); ++i) {
    if (std::abs(fit.pull[i]) > 2) pulling.push_back(static_cast<int>(i));
  }
  std::vector<ReportBlock> blocks = {
      ReportText{pulling.empty() ? "No measured base parameter pulls against bodies that can exist."
                                 : "Measured base parameters that pull against it by more than two "
                                   "deviations: " +
                                       names_of(report, pulling) + "."},
      std::move(table)};
  if (!fit.message.empty()) blocks.emplace_back(ReportCode{fit.message});
  sections.push_back(section_of("consistent", "Bodies that can exist", std::move(blocks)));
}

void add_conditioning(const FitReport& report, std::vector<ReportSection>& sections) {
  const Conditioning& own = report.conditioning;
  const Trust& trust = report.trust;
  ReportTable numbers{{"condition number", "", "without"}, {}, 0};
  numbers.rows = {
      {"regressor as it is", own.raw, ""},
      {"columns of unit norm", own.unit_norm, ""},
      {"columns over torque sensitivity", own.sensitivity, ""},
      {"low sensitivity removed", own.insensitive.condition_after,
       names_of(report, own.insensitive.removed)},
      {"near dependencies removed", own.dependent.condition_after,
       names_of(report, own.dependent.removed)},
      {"weakest directions left out", own.weakest.condition_after,
       fmt::format("{} of {} directions", report.robot.linear.size() - own.weakest.estimate.rank,
                   report.robot.linear.size())},
      {"essential parameters", own.essential.condition_after,
       names_of(report, own.essential.removed)}};
  ReportTable trusted{{"trust", ""}, {}, 0};
  trusted.rows = {{"noise of the regressor, norm", trust.regressor_noise},
                  {"residual, norm", trust.torque_noise},
                  {"bound of the relative parameter error", trust.perturbation_bound},
                  {"change of the singular values by noise", trust.singular_value_change},
                  {"beside the smallest one", trust.smallest_singular_value},
                  {"bias susceptibility", trust.bias_susceptibility}};
  sections.push_back(section_of(
      "conditioning", "How far to trust it",
      {ReportText{"Equations weighted by the noise of their joint; where nothing else is said, "
                  "columns of unit norm."},
       std::move(numbers), std::move(trusted)}));
}

/// Methods side by side.
void add_methods(const FitReport& report, std::vector<ReportSection>& sections) {
  if (report.fits.size() < 2) return;
  ReportTable table{{""}, {}, 0};
  for (const MethodFit& fit : report.fits) table.header.push_back(method_name(fit));
  const auto rows = [&](const char* name, VectorXd MethodFit::*values) {
    for (int j = 0; j < report.robot.linear.joints(); ++j) {
      Row row = {fmt::format("{} {}", name, joint_words(j))};
      for (const MethodFit& fit : report.fits) row.emplace_back(entry_of(fit.*values, j));
      table.rows.push_back(std::move(row));
    }
  };
  rows("% left,", &MethodFit::percent);
  if (report.data.heldout) rows("% left, held out,", &MethodFit::heldout_percent);
  for (int i = 0; i < report.robot.linear.size(); ++i) {
    Row row = {parameter_of(report, i).name};
    for (const MethodFit& fit : report.fits) row.emplace_back(fit.estimate.beta[i]);
    table.rows.push_back(std::move(row));
  }
  std::vector<ReportBlock> blocks = {std::move(table)};
  std::vector<std::string> messages;
  for (const MethodFit& fit : report.fits) {
    for (const std::string& own : fit.messages) messages.push_back(method_name(fit) + ": " + own);
  }
  if (!messages.empty()) blocks.emplace_back(ReportList{std::move(messages)});
  sections.push_back(section_of("methods", "Methods side by side", std::move(blocks)));
}

/// Robots that share inertia.
void add_hierarchy(const FitReport& report, std::vector<ReportSection>& sections) {
  if (!report.hierarchy) return;
  const HierarchyFit& fit = *report.hierarchy;
  ReportTable table{{"own parameter"}, {}, 0};
  for (const HierarchyFit::Robot& robot : fit.robots) {
    table.header.push_back(robot.name.empty() ? "(not named)" : robot.name);
    table.header.emplace_back("std");
  }
  for (std::size_t i = 0; i < fit.own.size(); ++i) {
    Row row = {parameter_of(report, fit.own[i]).name};
    for (const HierarchyFit::Robot& robot : fit.robots) {
      row.emplace_back(robot.own_beta[static_cast<Index>(i)]);
      row.emplace_back(robot.own_stddev[static_cast<Index>(i)]);
    }
    table.rows.push_back(std::move(row));
  }
  sections.push_back(section_of(
      "robots", "Robots that share inertia",
      {ReportText{fmt::format("{} robots share {} parameters; the friction of each is its own.",
                              fit.robots.size(), fit.shared.size())},
       std::move(table)}));
}

void add_recordings(const FitReport& report, std::vector<ReportSection>& sections) {
  if (report.recordings.empty()) return;
  ReportSection section{
      "condition", "Condition of the recordings", ReportSection::Kind::kPlain, {}};
  ReportTable table{
      {"file", "use", "length [s]", "rate [Hz]", "cut-off [Hz]", "an equation every [ms]"}, {}, 0};
  for (const RecordingLine& line : report.recordings) {
    table.rows.push_back({line.name, line.heldout ? "held out" : "fitted", line.seconds,
                          1 / line.condition.sample_time, line.cutoff > 0 ? line.cutoff : NAN,
                          1e3 * line.row_time});
  }
  section.parts.push_back({"", "", "", {std::move(table)}});
  for (const RecordingLine& line : report.recordings) {
    if (line.condition.messages.empty()) continue;
    section.parts.push_back({"", "", line.name, {ReportList{line.condition.messages}}});
  }
  sections.push_back(std::move(section));
}

}  // namespace

ReportDocument fit_document(const FitReport& report, const std::string& command) {
  ReportDocument document;
  document.kind = "fit";
  document.title = report.robot.linear.name;
  document.subtitle = "Parameters identified by dynid fit";
  const bool determined =
      report.unseen.empty() && (!report.effects || report.effects->fit.all_seen());
  document.state = determined ? "clean" : "insufficient_data";
  document.state_text = determined ? "determined" : "not all determined";
  document.origin = fmt::format("dynid {}.", DYNGEN_VERSION);
  document.sections.push_back(first_section(report));
  document.sections.push_back(parameter_section(report));
  add_effects(report, document.sections);
  add_torque(report, document.sections);
  if (report.two_encoders.any()) {
    document.sections.push_back(two_encoders_section(report.two_encoders));
  }
  if (report.ripples.any()) document.sections.push_back(ripple_section(report.ripples));
  if (report.steady.any()) document.sections.push_back(steady_section(report.steady));
  add_together(report, document.sections);
  add_unseen(report, document.sections);
  add_consistent(report, document.sections);
  add_hierarchy(report, document.sections);
  add_methods(report, document.sections);
  if (report.robot.linear.size() > 0) add_conditioning(report, document.sections);
  add_recordings(report, document.sections);
  document.sections.push_back(origin_section(command, document.origin));
  return document;
}

}  // namespace dyngen::runtime
