// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/fit_report.h"

#include <fmt/format.h>

#include <cmath>

#include "runtime/tools/dynid/identified_file.h"

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
  const double bound = fit.interval * std::sqrt(fit.estimate.covariance(parameter, parameter));
  return std::abs(fit.estimate.beta[parameter]) < bound ? Seen::kWeak : Seen::kYes;
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

std::string identified_file(const FitReport& report) {
  const MethodFit& fit = report.main();
  const LinearModel& model = report.robot.linear;
  std::vector<std::string> comment = {
      "", fmt::format(
              "identified by dynid fit ({}{}) from {} recording{}, {:.1f} s",
              fit_method_names()[static_cast<std::size_t>(fit.method)],
              report.consistent ? ", physically consistent" : "", report.data.summary.recordings,
              report.data.summary.recordings == 1 ? "" : "s", report.data.summary.seconds())};
  comment.push_back(
      report.consistent
          ? "full parameters of bodies that can exist; only the base parameters below were measured"
          : "base parameters: each stands for the combination named beside it, the others are 0");
  comment.push_back("value +- standard deviation:");
  const Eigen::VectorXd& beta = report.consistent ? report.consistent->beta : fit.estimate.beta;
  for (int i = 0; i < model.size(); ++i) {
    const LinearParameter& parameter = model.parameters[static_cast<std::size_t>(i)];
    std::string line = fmt::format("  {:<6} {:>13.6g}", parameter.name, beta[i]);
    if (fit.estimate.covariance.size() != 0) {
      line += fmt::format(" +- {:<10.3g}", std::sqrt(fit.estimate.covariance(i, i)));
    }
    line += fmt::format(" {:<9} {}", parameter.unit,
                        seen(report, i) == Seen::kNo ? "NOT SEEN in the data" : parameter.formula);
    while (!line.empty() && line.back() == ' ') line.pop_back();
    comment.push_back(line);
  }
  comment.emplace_back("");
  const StandardParameters standard =
      report.consistent ? report.consistent->standard : carried(report.robot, beta);
  return identified_text(report.robot, standard, comment);
}

}  // namespace dyngen::runtime
