// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/tools/dynid/excite/excite_report.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

std::string head(const ExciteReport& report) {
  const LinearModel& model = report.robot.linear;
  std::string text =
      fmt::format("{}: {} joints, {} of {} base parameters are asked about\n", model.name,
                  model.joints(), report.parameters.size(), model.size());
  for (const std::string& note : report.notes) text += "  " + note + "\n";
  return text;
}

std::string starts_table(const ExciteReport& report) {
  std::string text =
      fmt::format("\n{:<14}{:>14}{:>14}\n", "start, seed", "cond random", "cond then");
  for (const ExcitationStart& start : report.starts) {
    text += fmt::format("{:<14}{:>14.1f}{:>14.1f}\n", start.seed, start.random, start.optimised);
  }
  return text;
}

std::string share_text(double share, double limit) {
  return std::isfinite(limit) ? fmt::format("{:>14.3f}", share) : fmt::format("{:>14}", "no limit");
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 0 : values[values.size() / 2];
}

std::string deviations_table(const ExciteReport& report) {
  const LinearModel& model = report.robot.linear;
  std::string text =
      fmt::format("\nstandard deviations after {} of white torque noise{}\n",
                  report.repeats ? fmt::format("{} periods", report.periods) : "one pass",
                  report.prior ? ", with what the earlier recordings say" : "");
  text += fmt::format("{:<14}{:>14}{:>14}{:>14}{:>12}  {}\n", "parameter", "value", "std",
                      "% of value", "random/it", "unit");
  std::vector<double> ratios;
  for (std::size_t i = 0; i < report.parameters.size(); ++i) {
    const LinearParameter& parameter =
        model.parameters[static_cast<std::size_t>(report.parameters[i])];
    const double own = report.worth.deviations[static_cast<Index>(i)];
    const double ratio = report.random.deviations[static_cast<Index>(i)] /
                         report.worth.deviations[static_cast<Index>(i)];
    ratios.push_back(ratio);
    const bool known = parameter.value && *parameter.value != 0;
    text += fmt::format("{:<14}{:>14}{:>14.4g}{:>14}{:>12.2f}  {}\n", parameter.name,
                        parameter.value ? fmt::format("{:.5g}", *parameter.value) : "*", own,
                        known ? fmt::format("{:.2g}", 100 * own / std::abs(*parameter.value)) : "-",
                        ratio, parameter.unit);
  }
  text += fmt::format("median of random/it: {:.2f}\n", median(ratios));
  if (report.options.chosen_criterion() == "condition") {
    text += "  (--criterion d makes deviations small, this one the condition number)\n";
  }
  return text;
}

}  // namespace

std::string recording_advice(const ExciteReport& report) {
  const double rate = report.samples / report.duration;
  if (!report.repeats) {
    return fmt::format(
        "record it at {:.6g} Hz or a multiple, several times over: it does not come back to its "
        "start by itself, so let the arm return between recordings",
        rate);
  }
  // a scatter over P periods is known to 1 / sqrt(2 (P - 1)) at each phase, and far better over all
  constexpr int kLeast = 4, kEnough = 10;
  return fmt::format(
      "record {} to {} periods of {:.6g} s (this file: {}) at {:.6g} Hz or a multiple, {} whole "
      "samples a period: then 'dynid fit' averages periods and measures the noise",
      kLeast, kEnough, report.duration, report.periods, rate, report.samples);
}

std::string limits_table(const LinearModel& model, const MotionLimits& limits,
                         const LimitShares& shares, double check_rate) {
  std::string text =
      fmt::format("\nlargest share of each limit, looked at {:.0f} times a second\n", check_rate);
  text += fmt::format("{:<14}{:>14}{:>14}{:>14}{:>14}\n", "joint", "position", "speed",
                      "acceleration", "torque");
  for (Index j = 0; j < model.joints(); ++j) {
    const bool torque = limits.limits_torque();
    text += fmt::format("{:<14}{:>14.3f}", model.joint_names[static_cast<std::size_t>(j)],
                        shares.position[j]);
    text += share_text(shares.speed[j], limits.speed[j]);
    text += share_text(shares.acceleration[j], limits.acceleration[j]);
    text += share_text(shares.torque[j],
                       torque ? limits.torque[j] : std::numeric_limits<double>::infinity());
    text += "\n";
  }
  if (limits.box) {
    text += fmt::format("tool's point: never nearer than {:.4f} m to the box\n", shares.distance);
  }
  return text;
}

std::string text_of(const ExciteReport& report) {
  const LinearModel& model = report.robot.linear;
  std::string text = head(report);
  if (!report.starts.empty()) text += starts_table(report);
  if (!report.found) return text + "\nno trajectory: " + report.message + "\n";
  if (!report.message.empty()) text += report.message + "\n";
  text += fmt::format("\n{:<34}{:>12}{:>12}\n", "condition number of the regressor", "random",
                      "this one");
  text += fmt::format("{:<34}{:>12.1f}{:>12.2f}\n", "  SI units", report.random.condition,
                      report.worth.condition);
  text += fmt::format("{:<34}{:>12.1f}{:>12.2f}\n", "  columns of length 1",
                      report.random.unit_condition, report.worth.unit_condition);
  return text + limits_table(model, report.limits, report.shares) + deviations_table(report) +
         "\n" + recording_advice(report) + "\n";
}

}  // namespace dyngen::runtime
