// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/fit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/tools/dynid/robot/identified_file.h"

namespace dyngen::runtime {

using Eigen::Index;

namespace {

/// Bias by noise of the regressor, of a value, above which the value is no longer known.
constexpr double kBiasOfValue = 0.1;

}  // namespace

Seen seen(const FitReport& report, int parameter) {
  for (const UnseenCombination& combination : report.unseen) {
    for (const auto& [place, factor] : combination.terms) {
      if (place == parameter) return Seen::kNo;
    }
  }
  const MethodFit& fit = report.main();
  if (fit.estimate.covariance.size() == 0) return Seen::kYes;
  const double deviation = std::sqrt(fit.estimate.covariance(parameter, parameter));
  const double value = std::abs(fit.estimate.beta[parameter]);
  if (value < fit.interval * deviation) return Seen::kWeak;
  const double bias =
      report.trust.attenuation.size() != 0 ? std::abs(report.trust.attenuation[parameter]) : 0;
  return bias > std::max(kBiasOfValue * value, fit.interval * deviation) ? Seen::kWeak : Seen::kYes;
}

std::string_view seen_name(Seen seen) {
  switch (seen) {
    case Seen::kYes:
      return "yes";
    case Seen::kWeak:
      return "weak";
    default:
      return "no";
  }
}

namespace {

/// A line for each parameter: value +- standard deviation, unit, what it is.
void add_values(const FitReport& report, const Eigen::VectorXd& beta, const Eigen::VectorXd& stddev,
                std::vector<std::string>& comment) {
  const LinearModel& model = report.robot.linear;
  comment.emplace_back("value +- standard deviation:");
  for (int i = 0; i < model.size(); ++i) {
    const LinearParameter& parameter = model.parameters[static_cast<std::size_t>(i)];
    std::string line = fmt::format("  {:<6} {:>13.6g}", parameter.name, beta[i]);
    if (stddev.size() != 0) line += fmt::format(" +- {:<10.3g}", stddev[i]);
    line += fmt::format(" {:<9} {}", parameter.unit,
                        seen(report, i) == Seen::kNo ? "NOT SEEN in the data" : parameter.formula);
    while (line.back() == ' ') line.pop_back();
    comment.push_back(line);
  }
  comment.emplace_back("");
}

std::string origin(const FitReport& report, const std::string& how) {
  const RecordingSummary& summary = report.data.summary;
  return fmt::format("identified by dynid fit ({}) from {} recording{}, {:.1f} s", how,
                     summary.recordings, summary.recordings == 1 ? "" : "s", summary.seconds());
}

constexpr const char* kBaseParameters =
    "base parameters: each stands for the combination named beside it, the others are 0";

}  // namespace

std::string identified_file(const FitReport& report) {
  const MethodFit& fit = report.main();
  const std::string method(fit_method_names()[static_cast<std::size_t>(fit.method)]);
  const Eigen::VectorXd stddev =
      fit.estimate.covariance.size() != 0 ? fit.stddev() : Eigen::VectorXd();
  std::vector<std::string> comment = {""}, effects;
  if (report.effects) effects = effect_file_rows(*report.effects, report.robot);
  const auto add_effects = [&] {
    if (!report.effects) return;
    for (std::string& line : effect_comment(*report.effects)) comment.push_back(std::move(line));
  };
  if (report.consistent) {
    comment.push_back(origin(report, method + ", physically consistent"));
    comment.emplace_back(
        "full parameters of bodies that can exist; only these base parameters were measured");
    add_values(report, report.consistent->beta, stddev, comment);
    add_effects();
    return identified_text(report.robot, report.consistent->standard,
                           {comment, effects, {}, ParameterMeaning::kBodies});
  }
  comment.push_back(origin(report, method));
  if (report.robot.held.any()) {
    comment.push_back(
        fmt::format("kept as they were: {}", fmt::join(report.robot.held.names, " ")));
  }
  comment.emplace_back(kBaseParameters);
  add_values(report, fit.estimate.beta, stddev, comment);
  add_effects();
  const StandardParameters standard = report.effects
                                          ? carried_beside_rotors(report.robot, fit.estimate.beta)
                                          : carried(report.robot, fit.estimate.beta);
  return identified_text(report.robot, standard, {comment, effects});
}

std::string identified_file(const FitReport& report, std::size_t robot) {
  const HierarchyFit& hierarchy = *report.hierarchy;
  const HierarchyFit::Robot& own = hierarchy.robots[robot];
  const Eigen::VectorXd beta = own.beta(hierarchy);
  Eigen::VectorXd stddev(beta.size());
  stddev(hierarchy.shared) = hierarchy.shared_stddev;
  stddev(hierarchy.own) = own.own_stddev;
  std::vector<std::string> comment = {
      "", origin(report, fmt::format("robot {} of {}, inertia shared, friction its own", own.name,
                                     hierarchy.robots.size()))};
  comment.emplace_back(kBaseParameters);
  add_values(report, beta, stddev, comment);
  return identified_text(report.robot, carried(report.robot, beta), {comment});
}

}  // namespace dyngen::runtime
