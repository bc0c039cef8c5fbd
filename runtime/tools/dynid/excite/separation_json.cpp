// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/excite/excite_json.h"
#include "runtime/tools/dynid/excite/separation_report.h"

namespace dyngen::runtime {

std::string separation_json(const SeparationReport& report, const std::string& trajectory_path) {
  const SeparatingTrajectory& designed = report.designed;
  const int periods = report.periods;
  Json archetypes = Json::array();
  for (const ArchetypeScore& score : designed.scores) {
    archetypes.push_back({{"motion", words_of(score.archetype).motion},
                          {"joint", score.joint + 1},
                          {"separation", number(periods * score.least)}});
  }
  Json parameters = Json::object();
  for (int p = 0; p < report.effect.law.size(); ++p) {
    parameters[report.effect.law.parameters[static_cast<std::size_t>(p)].name] =
        number(report.effect.parameters[p]);
  }
  Json json = {
      {"schema", "dynid.separation/1"},
      {"robot", report.robot.linear.name},
      {"joints", report.robot.linear.joints()},
      {"found", designed.found},
      {"message", designed.message},
      {"notes", report.notes},
      {"findings", report.options.findings},
      {"finding",
       {{"effect", report.effect.law.name},
        {"family", report.finding.family},
        {"joint", report.finding.joint},
        {"parameters", std::move(parameters)}}},
      {"rivals", report.rivals},
      {"noise", {{"from", report.noise_from}, {"std", numbers(report.noise)}}},
      {"seed", report.options.seed},
      {"evaluations", designed.evaluations},
      {"archetypes", std::move(archetypes)},
      {"random",
       designed.random.rivals.empty() ? Json(nullptr) : number(periods * designed.random.least)}};
  if (designed.found) {
    Json rivals = Json::array();
    for (const RivalSeparation& rival : designed.separation.rivals) {
      rivals.push_back({{"effect", rival.rival.law.name},
                        {"family", rival.rival.law.family},
                        {"joint", rival.rival.joint + 1},
                        {"separation", number(periods * rival.lambda)}});
    }
    json["motion"] = words_of(designed.archetype).motion;
    json["instruction"] = instruction_of(report);
    json["separation"] = number(periods * designed.separation.least);
    json["visible"] = number(periods * designed.separation.visible);
    json["separations"] = std::move(rivals);
    json["largest_share_of_limits"] = shares_json(report.limits, designed.shares);
    json["trajectory"] = {{"file", trajectory_path},
                          {"period", report.duration},
                          {"samples_per_period", report.samples},
                          {"periods", periods},
                          {"rate", report.samples / report.duration}};
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace dyngen::runtime
