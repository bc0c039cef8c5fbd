// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "runtime/tools/dynid/excite/excite_report.h"
#include "runtime/tools/dynid/excite/motion_charts.h"
#include "runtime/tools/dynid/page/page_parts.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

std::string sentence_of(const ExciteReport& report) {
  if (!report.found) return "No trajectory: " + report.message + ".";
  return fmt::format(
      "A motion of {:.4g} s with a condition number of {:.3g}; a random one has {:.3g}.",
      report.duration, report.worth.condition, report.random.condition);
}

ReportFacts facts_of(const ExciteReport& report) {
  ReportFacts facts;
  facts.items = {{"condition number", fmt::format("{:.3g}", report.worth.condition),
                  fmt::format("random: {:.3g}", report.random.condition)},
                 {"with columns of length 1", fmt::format("{:.3g}", report.worth.unit_condition),
                  fmt::format("random: {:.3g}", report.random.unit_condition)},
                 {"asked about", fmt::format("{}", report.parameters.size()),
                  fmt::format("of {} base parameters", report.robot.linear.size())}};
  return facts;
}

/// Deviations beside those of the random motion; and how much of the value that is.
ReportTable deviations_of(const ExciteReport& report) {
  ReportTable table{
      {"parameter", "value", "std", "% of value", "std of the random motion", "unit", "what it is"},
      {},
      0};
  for (std::size_t i = 0; i < report.parameters.size(); ++i) {
    const LinearParameter& own =
        report.robot.linear.parameters[static_cast<std::size_t>(report.parameters[i])];
    const auto place = static_cast<Index>(i);
    const double std = report.worth.deviations[place];
    const bool known = own.value && *own.value != 0;
    table.rows.push_back({own.name, own.value ? ReportCell(*own.value) : ReportCell("not known"),
                          std,
                          known ? ReportCell(100 * std / std::abs(*own.value)) : ReportCell(""),
                          report.random.deviations[place], own.unit, own.formula});
  }
  return table;
}

ReportTable starts_of(const ExciteReport& report) {
  ReportTable table{{"seed", "condition number, random", "in the end"}, {}, kRowsShown};
  for (const ExcitationStart& start : report.starts) {
    table.rows.push_back({std::to_string(start.seed), start.random, start.optimised});
  }
  return table;
}

}  // namespace

ReportDocument excite_document(const ExciteReport& report, const std::string& command) {
  const LinearModel& model = report.robot.linear;
  ReportDocument document;
  document.kind = "excitation";
  document.title = model.name;
  document.subtitle = "A motion whose recording says most, by dynid excite";
  document.origin = fmt::format("dynid {}, seed {}.", DYNGEN_VERSION, report.options.seed);
  std::vector<ReportBlock> further;
  if (report.found) further.emplace_back(facts_of(report));
  if (!report.notes.empty()) further.emplace_back(ReportList{report.notes});
  document.sections.push_back(
      first_screen("Result", sentence_of(report), std::move(further),
                   report.found ? motion_arm(report.robot, report.trajectory) : ReportArm{},
                   report.found ? limit_bars(model, report.limits, report.shares) : ReportBars{}));
  if (report.found) {
    const Index rows = report.repeats ? Index{report.samples} + 1 : report.trajectory.samples();
    document.sections.push_back(
        section_of("trajectory", "The motion",
                   {ReportText{sentence(recording_advice(report))},
                    motion_chart(model, report.limits, report.trajectory, rows)}));
    document.sections.push_back(
        section_of("parameters", "How well parameters will be known",
                   {ReportText{fmt::format(
                        "Standard deviations after {} of white torque noise{}.",
                        report.repeats ? fmt::format("{} periods", report.periods) : "one pass",
                        report.prior ? ", with what the earlier recordings say" : "")},
                    deviations_of(report)}));
  }
  if (!report.starts.empty()) {
    document.sections.push_back(
        section_of("search", "The search",
                   {ReportText{fmt::format("{} trajectories were looked at.", report.evaluations)},
                    starts_of(report)}));
  }
  document.sections.push_back(origin_section(command, document.origin));
  return document;
}

}  // namespace dyngen::runtime
