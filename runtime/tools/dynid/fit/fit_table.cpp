// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "runtime/estimation/covariance.h"
#include "runtime/tools/dynid/fit/fit_report.h"
#include "runtime/tools/dynid/robot/joint_words.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.4g}", value) : std::string("-");
}

std::string percent_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.1f}", value) : std::string("-");
}

std::string percents_text(const VectorXd& values) {
  std::vector<std::string> texts;
  for (const double value : values) texts.push_back(percent_text(value));
  return fmt::format("{}", fmt::join(texts, " "));
}

/// Long sums are whole in the robot file and the JSON. What is said behind a sum stays.
std::string shortened(const std::string& whole) {
  constexpr std::size_t kMost = 44;
  const std::size_t behind = std::min(whole.find("; "), whole.size());
  const std::string formula = whole.substr(0, behind), remark = whole.substr(behind);
  if (formula.size() <= kMost) return whole;
  const std::size_t plus = formula.rfind(" + ", kMost), minus = formula.rfind(" - ", kMost);
  const std::size_t cut = plus == std::string::npos    ? minus
                          : minus == std::string::npos ? plus
                                                       : std::max(plus, minus);
  return formula.substr(0, cut == std::string::npos ? kMost : cut) + " ..." + remark;
}

std::string heading(const FitReport& report) {
  const RecordingSummary& summary = report.data.summary;
  const LinearModel& model = report.robot.linear;
  std::string text = fmt::format(
      "{}: {} joints, {} base parameters; {} recording{}, {:.1f} s, {:.0f} equations a joint\n",
      model.name, model.joints(), model.size(), summary.recordings,
      summary.recordings == 1 ? "" : "s", summary.seconds(), summary.equations.samples());
  const std::string legend = joint_legend(report.robot.model);
  if (!legend.empty()) text += "  " + legend + "\n";
  for (const RecordingLine& line : report.recordings) {
    text +=
        fmt::format("  {}{}: {:.1f} s at {:.6g} Hz", line.name, line.heldout ? " (held out)" : "",
                    line.seconds, 1 / line.condition.sample_time);
    if (line.cutoff > 0) text += fmt::format("; cut-off {:.3g} Hz", line.cutoff);
    text += fmt::format("; an equation every {:.3g} ms\n", 1e3 * line.row_time);
    for (const std::string& message : line.condition.messages) {
      text += fmt::format("    {}\n", message);
    }
  }
  return text;
}

std::string parameter_rows(const FitReport& report) {
  const LinearModel& model = report.robot.linear;
  if (model.size() == 0) return "";
  const MethodFit& fit = report.main();
  const bool known = fit.estimate.covariance.size() != 0;
  std::string text = fmt::format("\n{:<8}{:>11}{:>10}{:>7}  {:<10}{:<5}", "", "value", "stddev",
                                 "%", "unit", "seen");
  text += report.consistent ? fmt::format("{:>12}{:>7}\n", "consistent", "pull") : " what it is\n";
  std::vector<Seen> states;
  for (int i = 0; i < model.size(); ++i) states.push_back(seen(report, i));
  // where joints stand, nearly all parameters are hidden: a list of them would hide the others
  const auto hidden = std::count(states.begin(), states.end(), Seen::kNo);
  const bool brief = 2 * hidden > model.size();
  for (int i = 0; i < model.size(); ++i) {
    const LinearParameter& parameter = model.parameters[static_cast<std::size_t>(i)];
    const double value = fit.estimate.beta[i];
    const double stddev = known ? std::sqrt(fit.estimate.covariance(i, i)) : 0;
    const Seen state = states[static_cast<std::size_t>(i)];
    if (brief && state == Seen::kNo) continue;
    std::string line = fmt::format("{:<8}{:>11.5g}", parameter.name, value);
    if (known && state != Seen::kNo) {
      const double relative = value != 0 ? 100 * stddev / std::abs(value) : INFINITY;
      line += fmt::format("{:>10.3g}{:>7}", stddev,
                          relative < 1000 ? fmt::format("{:.1f}", relative) : ">1000");
    } else {
      line += fmt::format("{:>10}{:>7}", "-", "-");
    }
    line += fmt::format("  {:<10}{:<5}", parameter.unit, seen_name(state));
    line += report.consistent ? fmt::format("{:>12.5g}{:>7.1f}", report.consistent->beta[i],
                                            report.consistent->pull[i])
                              : " " + shortened(parameter.formula);
    text += line + "\n";
  }
  if (brief) text += fmt::format("{} parameters that are not seen alone have no row\n", hidden);
  return text;
}

std::string joint_rows(const FitReport& report) {
  const MethodFit& fit = report.main();
  const LinearModel& model = report.robot.linear;
  const bool heldout = fit.heldout_rms.size() != 0;
  std::string text =
      fmt::format("\n{:<9}{:>10}{:>13}{:>10}", "residual", "equations", "rms", "% torque");
  if (heldout) text += fmt::format("{:>10}{:>10}", "held-out", "% torque");
  const VectorXd times = report.data.summary.noise.correlation_time();
  text += fmt::format("{:>16}\n", "correlated over");
  for (int j = 0; j < model.joints(); ++j) {
    const double rows = report.data.summary.equations.joints[static_cast<std::size_t>(j)].rows;
    text += fmt::format("{:<9}{:>9.0f} {:>9} {:<3}{:>10}", fmt::format("joint {}", j + 1), rows,
                        number_text(fit.estimate.residual_rms[j]),
                        model.revolute[static_cast<std::size_t>(j)] ? "N m" : "N",
                        percent_text(fit.percent[j]));
    if (heldout) {
      text += fmt::format("{:>10}{:>10}", number_text(fit.heldout_rms[j]),
                          percent_text(fit.heldout_percent[j]));
    }
    text += rows > 0 ? fmt::format("{:>14.3g} s\n",
                                   std::max(1.0, times[j]) * report.data.summary.row_time)
                     : fmt::format("{:>14}\n", "-");
  }
  return text;
}

std::string names_text(const FitReport& report, const std::vector<int>& parameters) {
  constexpr std::size_t kMost = 8;
  std::string text;
  for (std::size_t i = 0; i < parameters.size() && i < kMost; ++i) {
    text += (i > 0 ? " " : "") +
            report.robot.linear.parameters[static_cast<std::size_t>(parameters[i])].name;
  }
  if (parameters.size() > kMost) text += fmt::format(" and {} more", parameters.size() - kMost);
  return text;
}

std::string conditioning_rows(const FitReport& report) {
  const Conditioning& c = report.conditioning;
  std::string text = "\ncondition number\n";
  text += fmt::format("  {:<42}{:>10}\n", "regressor as it is", number_text(c.raw));
  text += fmt::format("  {:<42}{:>10}\n", "columns of unit norm", number_text(c.unit_norm));
  text += fmt::format("  {:<42}{:>10}\n", "columns over torque sensitivity",
                      number_text(c.sensitivity));
  const auto analysis = [&](const char* name, const Significance& s) {
    text += fmt::format(
        "  {:<42}{:>10}  {}\n", name, number_text(s.condition_after),
        s.removed.empty() ? "nothing to remove" : "without " + names_text(report, s.removed));
  };
  analysis("(a) low sensitivity removed, unscaled", c.insensitive);
  analysis("(b) near dependencies removed, scaled", c.dependent);
  text +=
      fmt::format("  {:<42}{:>10}  {} of {} directions left out\n",
                  "(c) weakest directions left out, scaled", number_text(c.weakest.condition_after),
                  report.robot.linear.size() - c.weakest.estimate.rank, report.robot.linear.size());
  text += fmt::format("  {:<42}{:>10}  {} of {}\n", "essential parameters",
                      number_text(c.essential.condition_after), c.essential.kept.size(),
                      report.robot.linear.size());
  return text;
}

std::string trust_rows(const FitReport& report) {
  const Trust& trust = report.trust;
  const VectorXd relative_attenuation =
      trust.attenuation.cwiseQuotient(report.main().estimate.scale);
  const double size =
      report.main().estimate.beta.cwiseQuotient(report.main().estimate.scale).norm();
  std::string text = "\ntrust (equations weighted, columns of unit norm)\n";
  const auto row = [&](const char* name, const std::string& value) {
    text += fmt::format("  {:<58}{:>10}\n", name, value);
  };
  row("noise of the regressor, norm", number_text(trust.regressor_noise));
  row("residual, norm", number_text(trust.torque_noise));
  row("bound of the relative parameter error (4.1)",
      std::isfinite(trust.perturbation_bound) ? fmt::format("{:.3g}", trust.perturbation_bound)
                                              : std::string("none"));
  row("bias by noise of the regressor, relative (5.2)",
      number_text(size > 0 ? relative_attenuation.norm() / size : 0));
  row("time constant of LMS, s (5.6)", number_text(trust.time_constant));
  row("change of the singular values by noise (5.7)", number_text(trust.singular_value_change));
  row("  beside the smallest one", number_text(trust.smallest_singular_value));
  row("bias susceptibility", number_text(trust.bias_susceptibility));
  return text;
}

std::string together_rows(const FitReport& report) {
  if (report.together.empty()) return "";
  std::string text = "\nseen only together\n";
  for (const SeenCombination& own : report.together) {
    text += fmt::format("  {}\n    {:.5g}", own.text, own.value);
    if (std::isfinite(own.stddev)) text += fmt::format(" +- {:.2g}", own.stddev);
    text += " " + own.unit + "\n";
  }
  return text;
}

std::string unseen_rows(const FitReport& report) {
  constexpr std::size_t kMostAlone = 10;  // more are put together by what would show them
  if (report.unseen.empty()) return "";
  std::string text = "\nnot seen in these recordings\n";
  if (report.unseen.size() <= kMostAlone) {
    for (const UnseenCombination& combination : report.unseen) {
      text += fmt::format("  {}\n    {}\n", combination.text, combination.advice);
    }
    return text;
  }
  std::vector<std::pair<std::string, std::vector<std::string>>> by_advice;
  for (const UnseenCombination& combination : report.unseen) {
    auto own = std::find_if(by_advice.begin(), by_advice.end(),
                            [&](const auto& known) { return known.first == combination.advice; });
    if (own == by_advice.end()) own = by_advice.insert(own, {combination.advice, {}});
    own->second.push_back(combination.text);
  }
  for (const auto& [advice, texts] : by_advice) {
    text += fmt::format("  {}\n    {}\n", fmt::join(texts, ", "), advice);
  }
  return text;
}

std::string consistent_rows(const FitReport& report) {
  if (!report.consistent) return "";
  const ConsistentFit& fit = *report.consistent;
  std::string text =
      fmt::format("\nphysically consistent: residual per joint {} % of torque (free: {} %)\n",
                  percents_text(fit.percent), percents_text(report.main().percent));
  if (fit.heldout_percent.size() != 0) {
    text += fmt::format("  held-out: {} % (free: {} %)\n", percents_text(fit.heldout_percent),
                        percents_text(report.main().heldout_percent));
  }
  std::vector<int> pulling;
  for (Index i = 0; i < fit.pull.size(); ++i) {
    if (std::abs(fit.pull[i]) > 2) pulling.push_back(static_cast<int>(i));
  }
  text += pulling.empty()
              ? "  no measured base parameter pulls against it\n"
              : fmt::format("  measured base parameters that pull against it (> 2 stddev): {}\n",
                            names_text(report, pulling));
  if (!fit.converged) text += "  the search did not end: the last step is given\n";
  if (!fit.message.empty()) {
    std::string line;
    for (const char c : fit.message + "\n") {
      if (c != '\n') {
        line += c;
      } else if (!line.empty()) {
        text += "  " + line + "\n";
        line.clear();
      }
    }
  }
  return text;
}

/// @param robots  as many as a line holds
std::string hierarchy_block(const FitReport& report, std::span<const HierarchyFit::Robot> robots) {
  const HierarchyFit& fit = *report.hierarchy;
  std::string text = fmt::format("{:<10}", "");
  for (const HierarchyFit::Robot& robot : robots) {
    text += fmt::format("{:>22}", robot.name.empty() ? "(not named)" : robot.name);
  }
  text += "\n";
  for (std::size_t i = 0; i < fit.own.size(); ++i) {
    text += fmt::format("{:<10}",
                        report.robot.linear.parameters[static_cast<std::size_t>(fit.own[i])].name);
    for (const HierarchyFit::Robot& robot : robots) {
      text += fmt::format("{:>11.4g} +- {:<7.2g}", robot.own_beta[static_cast<Index>(i)],
                          robot.own_stddev[static_cast<Index>(i)]);
    }
    text += "\n";
  }
  for (int j = 0; j < report.robot.linear.joints(); ++j) {
    text += fmt::format("{:<10}", fmt::format("fit % {}", j + 1));
    for (const HierarchyFit::Robot& robot : robots) {
      text += fmt::format("{:>22.1f}", robot.percent[j]);
    }
    text += "\n";
  }
  return text;
}

/// Robots that share inertia: their own friction beside each other.
std::string hierarchy_rows(const FitReport& report) {
  constexpr std::size_t kOfALine = 3;
  if (!report.hierarchy) return "";
  const HierarchyFit& fit = *report.hierarchy;
  std::string text = fmt::format("\n{} robots share {} parameters; own friction of each:\n",
                                 fit.robots.size(), fit.shared.size());
  for (std::size_t i = 0; i < fit.robots.size(); i += kOfALine) {
    const std::span<const HierarchyFit::Robot> all(fit.robots);
    text += hierarchy_block(report, all.subspan(i, std::min(kOfALine, all.size() - i)));
  }
  return text;
}

/// Methods side by side, as the thesis's Tables 7.3 to 7.5. @param fits  as many as a line holds
std::string method_block(const FitReport& report, std::span<const MethodFit> fits) {
  const LinearModel& model = report.robot.linear;
  std::string text = fmt::format("\n{:<10}", "methods");
  for (const MethodFit& fit : fits) {
    text += fmt::format("{:>11}", fit_method_names()[static_cast<std::size_t>(fit.method)]);
  }
  text += "\n";
  for (int i = 0; i < model.size(); ++i) {
    text += fmt::format("{:<10}", model.parameters[static_cast<std::size_t>(i)].name);
    for (const MethodFit& fit : fits) text += fmt::format("{:>11.4g}", fit.estimate.beta[i]);
    text += "\n";
  }
  const auto percents = [&](const char* name, auto values) {
    for (int j = 0; j < model.joints(); ++j) {
      text += fmt::format("{:<10}", fmt::format("{} {}", name, j + 1));
      for (const MethodFit& fit : fits) {
        const VectorXd& of_fit = values(fit);
        text += fmt::format("{:>11}", of_fit.size() != 0 ? percent_text(of_fit[j]) : "-");
      }
      text += "\n";
    }
  };
  percents("fit %", [](const MethodFit& fit) -> const VectorXd& { return fit.percent; });
  if (report.data.heldout) {
    percents("held %", [](const MethodFit& fit) -> const VectorXd& { return fit.heldout_percent; });
  }
  return text;
}

std::string method_columns(const FitReport& report) {
  constexpr std::size_t kOfALine = 6;
  if (report.fits.size() < 2) return "";
  std::string text;
  for (std::size_t i = 0; i < report.fits.size(); i += kOfALine) {
    const std::span<const MethodFit> all(report.fits);
    text += method_block(report, all.subspan(i, std::min(kOfALine, all.size() - i)));
  }
  return text;
}

}  // namespace

std::string fit_table(const FitReport& report) {
  const bool any = report.robot.linear.size() > 0;
  std::string text = heading(report) + parameter_rows(report) +
                     (report.effects ? effect_rows(*report.effects, report.robot) : "") +
                     joint_rows(report) + two_encoders_text(report.two_encoders) +
                     ripple_text(report.ripples) + steady_text(report.steady) +
                     (any ? conditioning_rows(report) : "") + (any ? trust_rows(report) : "") +
                     consistent_rows(report) + together_rows(report) + unseen_rows(report) +
                     hierarchy_rows(report) + method_columns(report);
  std::string messages;
  for (const MethodFit& fit : report.fits) {
    for (const std::string& message : fit.messages) {
      messages += fmt::format("{}: {}\n", fit_method_names()[static_cast<std::size_t>(fit.method)],
                              message);
    }
  }
  for (const std::string& note : report.notes) messages += note + "\n";
  if (!messages.empty()) text += "\n" + messages;
  return text;
}

}  // namespace dyngen::runtime
