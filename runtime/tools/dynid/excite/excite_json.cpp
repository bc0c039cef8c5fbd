// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/excite_json.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Json parameters(const ExciteReport& report) {
  Json array = Json::array();
  for (std::size_t i = 0; i < report.parameters.size(); ++i) {
    const LinearParameter& parameter =
        report.robot.linear.parameters[static_cast<std::size_t>(report.parameters[i])];
    array.push_back({{"name", parameter.name},
                     {"unit", parameter.unit},
                     {"value", parameter.value ? Json(*parameter.value) : Json(nullptr)},
                     {"std", number(report.worth.deviations[static_cast<Index>(i)])},
                     {"std_of_random", number(report.random.deviations[static_cast<Index>(i)])}});
  }
  return array;
}

}  // namespace

Json shares_json(const MotionLimits& limits, const LimitShares& shares, double check_rate) {
  return {{"check_rate", check_rate},
          {"position", numbers(shares.position)},
          {"speed", numbers(shares.speed)},
          {"acceleration", numbers(shares.acceleration)},
          {"torque", limits.limits_torque() ? numbers(shares.torque) : Json(nullptr)},
          {"box_distance", number(shares.distance)}};
}

std::string json_of(const ExciteReport& report, const std::string& trajectory_path) {
  Json starts = Json::array();
  for (const ExcitationStart& start : report.starts) {
    starts.push_back({{"seed", start.seed},
                      {"condition_random", number(start.random)},
                      {"condition_optimised", number(start.optimised)}});
  }
  Json json = {{"schema", "dynid.excitation/1"},
               {"robot", report.robot.linear.name},
               {"joints", report.robot.linear.joints()},
               {"found", report.found},
               {"message", report.message},
               {"notes", report.notes},
               {"form", report.options.form},
               {"criterion", report.options.chosen_criterion()},
               {"unit_columns", report.options.unit_columns},
               {"noise", numbers(report.noise)},
               {"starts", starts},
               {"evaluations", report.evaluations}};
  if (report.found) {
    json["trajectory"] = {{"file", trajectory_path},
                          {"period", report.duration},
                          {"samples_per_period", report.samples},
                          {"periods", report.repeats ? report.periods : 1},
                          {"rate", report.samples / report.duration},
                          {"repeats", report.repeats}};
    json["condition"] = {{"random", number(report.random.condition)},
                         {"optimised", number(report.worth.condition)},
                         {"random_unit_columns", number(report.random.unit_condition)},
                         {"optimised_unit_columns", number(report.worth.unit_condition)}};
    json["largest_share_of_limits"] = shares_json(report.limits, report.shares);
    json["parameters"] = parameters(report);
  }
  return json.dump(2) + "\n";
}

}  // namespace dyngen::runtime
