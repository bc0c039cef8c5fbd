// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/excite_json.h"
#include "runtime/tools/dynid/excite/programme_report.h"

namespace dyngen::runtime {

std::string programme_json(const ProgrammeReport& report, const std::string& trajectory_path) {
  Json steps = Json::array();
  for (const ProgrammeStep& step : report.programme.steps) {
    steps.push_back({{"joint", step.joint + 1},
                     {"begin", step.begin},
                     {"seconds", step.seconds},
                     {"speed", step.speed},
                     {"from", step.from},
                     {"to", step.to},
                     {"side", step.side}});
  }
  Json json = {
      {"schema", "dynid.programme/1"},
      {"robot", report.robot.linear.name},
      {"joints", report.robot.linear.joints()},
      {"archetype", report.options.archetype},
      {"found", report.found},
      {"message", report.message},
      {"notes", report.notes},
      {"steps", std::move(steps)},
      {"largest_share_of_limits", shares_json(report.limits, report.shares, kProgrammeCheckRate)}};
  if (report.found) {
    json["trajectory"] = {{"file", trajectory_path},
                          {"period", report.duration},
                          {"samples_per_period", report.samples},
                          {"periods", report.periods},
                          {"rate", report.options.rate},
                          {"repeats", true}};
  }
  return json.dump(2) + "\n";
}

}  // namespace dyngen::runtime
