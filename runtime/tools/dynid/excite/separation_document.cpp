// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "runtime/diagnosis/scans/hypothesis.h"
#include "runtime/tools/dynid/excite/motion_charts.h"
#include "runtime/tools/dynid/excite/separation_report.h"
#include "runtime/tools/dynid/page/page_parts.h"

namespace dyngen::runtime {
namespace {

std::string names_of(const SeparationReport& report) {
  return fmt::format("{} from {}", report.finding.family, fmt::join(report.rivals, " and "));
}

/// Large ones without digits behind the point.
std::string chi_square_words(double squares) {
  return squares < 100 ? fmt::format("{:.3g}", squares) : fmt::format("{:.0f}", squares);
}

std::string sentence_of(const SeparationReport& report) {
  if (!report.designed.found) {
    return fmt::format("No trajectory tells {}: {}.", names_of(report), report.designed.message);
  }
  const int periods = report.periods;
  const double least = periods * report.designed.separation.least;
  if (least >= kSeparated) {
    return fmt::format("{} periods of this motion separate {}: chi-square {}; {:.0f} is needed.",
                       periods, names_of(report), chi_square_words(least), kSeparated);
  }
  return fmt::format(
      "{} periods of this motion do not yet separate {}: chi-square {}; {:.0f} is needed, which "
      "{:.0f} periods give.",
      periods, names_of(report), chi_square_words(least), kSeparated,
      std::ceil(kSeparated / report.designed.separation.least));
}

/// Separation of each rival, on this motion and on a random one.
ReportBars rival_bars(const SeparationReport& report) {
  const int periods = report.periods;
  ReportBars bars;
  bars.id = "separation";
  bars.title = "How far rivals are from what was found";
  bars.caption = fmt::format(
      "Chi-square after {} periods, each rival at its nearest. Names are separable from {:.0f} on. "
      "Each rival has its own scale.",
      periods, kSeparated);
  const auto random = nearest_rivals(report.designed.random);
  for (const auto& [family, rival] : nearest_rivals(report.designed.separation)) {
    const auto before = random.find(family);
    bars.groups.push_back({family,
                           "chi-square",
                           periods * rival.lambda >= kSeparated,
                           {{"random motion", Role::kFloor,
                             before == random.end() ? NAN : periods * before->second.lambda},
                            {"this one", Role::kAfter, periods * rival.lambda}}});
  }
  return bars;
}

ReportTable archetypes_of(const SeparationReport& report) {
  ReportTable table{{"motion", "moves", "chi-square"}, {}, kRowsShown};
  for (const ArchetypeScore& score : report.designed.scores) {
    table.rows.push_back({words_of(score.archetype).motion,
                          score.joint < 0 ? "all joints" : joint_words(score.joint),
                          report.periods * score.least});
  }
  return table;
}

}  // namespace

ReportDocument separation_document(const SeparationReport& report, const std::string& command) {
  const LinearModel& model = report.robot.linear;
  ReportDocument document;
  document.kind = "experiment";
  document.title = model.name;
  document.subtitle = "A motion that tells names apart, by dynid excite --for";
  document.origin = fmt::format("dynid {}, seed {}.", DYNGEN_VERSION, report.options.seed);
  std::vector<ReportBlock> further;
  std::vector<std::string> notes = report.notes;
  for (const std::string& rival : report.designed.left_out) {
    notes.push_back("left out, since a planned motion does not say: " + rival);
  }
  notes.push_back("noise of a torque sample: " + report.noise_from);
  further.emplace_back(ReportList{std::move(notes)});
  const bool found = report.designed.found;
  document.sections.push_back(
      first_screen("Result", sentence_of(report), std::move(further),
                   found ? motion_arm(report.robot, report.trajectory) : ReportArm{},
                   found ? rival_bars(report) : ReportBars{}));
  if (found) {
    std::vector<ReportBlock> blocks = {ReportText{sentence(recording_advice(report))}};
    const std::string instruction = instruction_of(report);
    if (!instruction.empty()) blocks.emplace_back(ReportText{instruction});
    blocks.emplace_back(motion_chart(model, report.limits, report.trajectory, report.samples + 1));
    blocks.emplace_back(limit_bars(model, report.limits, report.designed.shares));
    document.sections.push_back(section_of("trajectory", "The motion", std::move(blocks)));
  }
  if (!report.designed.scores.empty()) {
    document.sections.push_back(
        section_of("search", "Motions that were tried",
                   {ReportText{"The nearest rival of each before the best was refined."},
                    archetypes_of(report)}));
  }
  document.sections.push_back(origin_section(command, document.origin));
  return document;
}

}  // namespace dyngen::runtime
