// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit/fit_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/tools/dynid/robot/identified_file.h"

namespace dyngen::runtime {

using Eigen::Index;

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
  return value < fit.interval * deviation ? Seen::kWeak : Seen::kYes;
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

constexpr const char* kBodiesOfBaseParameters =
    "base parameters: recordings determine these sums alone. The bodies in this file have them and "
    "are as near to those before as such bodies can be";

}  // namespace

std::vector<std::string> identified_comment(const FitReport& report, bool of_description) {
  const MethodFit& fit = report.main();
  const std::string method(fit_method_names()[static_cast<std::size_t>(fit.method)]);
  const Eigen::VectorXd stddev =
      fit.estimate.covariance.size() != 0 ? fit.stddev() : Eigen::VectorXd();
  std::vector<std::string> comment = {""};
  if (report.consistent) {
    comment.push_back(origin(report, method + ", physically consistent"));
    comment.emplace_back(
        "full parameters of bodies that can exist; only these base parameters were measured");
    add_values(report, report.consistent->beta, stddev, comment);
  } else {
    comment.push_back(origin(report, method));
    if (report.robot.held.any()) {
      comment.push_back(
          fmt::format("kept as they were: {}", fmt::join(report.robot.held.names, " ")));
    }
    comment.emplace_back(of_description ? kBodiesOfBaseParameters : kBaseParameters);
    add_values(report, fit.estimate.beta, stddev, comment);
  }
  if (report.effects) {
    for (std::string& line : effect_comment(*report.effects)) comment.push_back(std::move(line));
  }
  return comment;
}

std::string identified_file(const FitReport& report) {
  const std::vector<std::string> comment = identified_comment(report, false);
  std::vector<std::string> effects;
  if (report.effects) effects = effect_file_rows(*report.effects, report.robot);
  if (report.consistent) {
    return identified_text(report.robot, report.consistent->standard,
                           {comment, effects, {}, ParameterMeaning::kBodies});
  }
  const Eigen::VectorXd& beta = report.main().estimate.beta;
  const StandardParameters standard =
      report.effects ? carried_beside_rotors(report.robot, beta) : carried(report.robot, beta);
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
