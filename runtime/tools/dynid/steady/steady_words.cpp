// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "runtime/tools/dynid/page/page_parts.h"
#include "runtime/tools/dynid/steady/steady_report.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string interval_text(double low, double high) {
  return fmt::format("{:.4g} .. {:.4g}", low, high);
}

std::string test_text(const TermTest& test) {
  if (test.below <= 0) return "too few levels";
  return fmt::format("F(1, {:.0f}) = {:.4g}, p = {:.2g}{}", test.below, test.ratio, test.chance,
                     test.tried > 1 ? fmt::format(" ({} shapes)", test.tried) : "");
}

std::string pose_text(const HeldPair& pair) {
  std::string text;
  for (const double q : pair.q) text += fmt::format("{}{:.3g}", text.empty() ? "" : " ", q);
  return text;
}

std::string points_table(const SteadyResult& result) {
  std::string text;
  for (const FrictionPoint& point : result.points) {
    text += fmt::format("  {:>12.4g}{:>12.4g}  {:<24}{:>5}{:>9.3g}\n", point.speed, point.torque,
                        interval_text(point.low, point.high), point.runs, point.seconds);
  }
  if (text.empty()) return text;
  return fmt::format("  {:>12}{:>12}  {:<24}{:>5}{:>9}\n", "speed", "friction", "95 % interval",
                     "runs", "s") +
         text;
}

std::string poses_table(const SteadyResult& result) {
  std::string text;
  for (const HeldPair& pair : result.poses.pairs) {
    text += fmt::format("  {:>10.4g}  {:<22}{:>10.4g}  {:<22}{}\n", pair.gravity.value,
                        interval_text(pair.gravity.low, pair.gravity.high), pair.friction.value,
                        interval_text(pair.friction.low, pair.friction.high), pose_text(pair));
  }
  if (text.empty()) return text;
  return fmt::format("  {:>10}  {:<22}{:>10}  {:<22}{}\n", "gravity", "95 % interval", "held back",
                     "95 % interval", "pose") +
         text;
}

/// Forward and backward curves over the speed without its sign, with intervals, and the form.
ReportChart curve_chart(const SteadyResult& result) {
  ReportChart chart;
  chart.id = fmt::format("steady-joint-{}", result.joint + 1);
  chart.title = fmt::format("Friction over the speed of joint {}", result.joint + 1);
  chart.caption =
      "Mean torque of runs of constant speed, less gravity and the constant torque. Bands: 95 % "
      "intervals by the slow noise.";
  ReportPanel panel;
  panel.x_label = fmt::format("speed [{}]", result.revolute ? "rad/s" : "m/s");
  panel.y_label = fmt::format("friction [{}]", result.revolute ? "N m" : "N");
  const auto count = static_cast<Index>(result.points.size());
  panel.x.resize(count);
  ReportSeries measured{"measured", Role::kData, VectorXd(count), VectorXd(count), VectorXd(count),
                        false,      true};
  ReportSeries fitted{"form", Role::kModel, VectorXd(count), {}, {}, true, false};
  for (Index k = 0; k < count; ++k) {
    const FrictionPoint& point = result.points[static_cast<std::size_t>(k)];
    panel.x[k] = point.speed;
    measured.y[k] = point.torque;
    measured.low[k] = point.low;
    measured.high[k] = point.high;
    fitted.y[k] = result.forms.judged
                      ? friction_at(result.forms.form(), result.postures, point.speed)
                      : std::numeric_limits<double>::quiet_NaN();
  }
  panel.series.push_back(std::move(measured));
  if (result.forms.judged) panel.series.push_back(std::move(fitted));
  chart.views.push_back({"friction", {std::move(panel)}});
  return chart;
}

ReportTable numbers_table(const SteadyJoints& steady) {
  ReportTable table{{"", "parameter", "value", "95 % interval", "unit"}, {}, 0};
  for (const SteadyResult& result : steady.joints) {
    for (const FrictionNumber& own : result.forms.numbers) {
      table.rows.push_back({joint_words(result.joint), own.name, own.value,
                            own.high > own.low ? interval_text(own.low, own.high) : "given",
                            own.unit});
    }
  }
  return table;
}

ReportTable tests_table(const SteadyJoints& steady) {
  ReportTable table{{"", "term", "test", ""}, {}, 0};
  for (const SteadyResult& result : steady.joints) {
    for (const TermTest& test : result.forms.tests) {
      table.rows.push_back({joint_words(result.joint), std::string(term_name(test.term)),
                            test_text(test), test.kept ? "kept" : ""});
    }
  }
  return table;
}

ReportTable poses_of_page(const SteadyJoints& steady) {
  ReportTable table{
      {"", "pose", "gravity", "95 % interval", "held back", "95 % interval"}, {}, kRowsShown};
  for (const SteadyResult& result : steady.joints) {
    for (const HeldPair& pair : result.poses.pairs) {
      table.rows.push_back({joint_words(result.joint), pose_text(pair), pair.gravity.value,
                            interval_text(pair.gravity.low, pair.gravity.high), pair.friction.value,
                            interval_text(pair.friction.low, pair.friction.high)});
    }
  }
  return table;
}

std::string runs_text(const SteadyResult& result) {
  return fmt::format("{} runs of constant speed, {:.3g} s", result.runs, result.seconds);
}

}  // namespace

std::string steady_text(const SteadyJoints& steady) {
  if (!steady.any()) return {};
  std::string text = "\nsteady speeds and held poses\n";
  for (const SteadyResult& result : steady.joints) {
    text += fmt::format("joint {}: ", result.joint + 1);
    if (result.runs > 0) {
      text += runs_text(result) + "\n  " + friction_sentence(result) + "\n";
    } else {
      text += "held poses\n";
    }
    for (const TermTest& test : result.forms.tests) {
      text += fmt::format("  {:<12}{}{}\n", term_name(test.term), test_text(test),
                          test.kept ? ", kept" : "");
    }
    text += points_table(result) + poses_table(result);
    if (result.poses.one_sided > 0) {
      text += fmt::format("  {} poses were reached from one side alone and bound nothing\n",
                          result.poses.one_sided);
    }
    for (const std::string& remark : result.remarks) text += "  " + remark + "\n";
  }
  for (const std::string& remark : steady.remarks) text += remark + "\n";
  return text;
}

ReportSection steady_section(const SteadyJoints& steady) {
  std::vector<ReportBlock> blocks;
  std::vector<std::string> sentences;
  bool poses = false, forms = false;
  for (const SteadyResult& result : steady.joints) {
    const std::string joint = joint_words(result.joint);
    if (result.runs > 0) {
      sentences.push_back(
          fmt::format("{}: {}. {}", joint, runs_text(result), friction_sentence(result)));
    }
    for (const std::string& remark : result.remarks) {
      sentences.push_back(fmt::format("{}: {}", joint, remark));
    }
    poses = poses || !result.poses.pairs.empty();
    forms = forms || result.forms.judged;
  }
  sentences.insert(sentences.end(), steady.remarks.begin(), steady.remarks.end());
  if (!sentences.empty()) blocks.emplace_back(ReportList{std::move(sentences)});
  for (const SteadyResult& result : steady.joints) {
    if (!result.points.empty()) blocks.emplace_back(curve_chart(result));
  }
  if (forms) {
    blocks.emplace_back(numbers_table(steady));
    blocks.emplace_back(tests_table(steady));
  }
  if (poses) blocks.emplace_back(poses_of_page(steady));
  return section_of("steady", "Steady speeds and held poses", std::move(blocks));
}

}  // namespace dyngen::runtime
