// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/atlas/atlas_report.h"
#include "runtime/tools/dynid/robot/json_numbers.h"

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr std::size_t kAliasesInJson = 5;

const char* absorbed_name(Absorbed kind) {
  switch (kind) {
    case Absorbed::kOnAnyData:
      return "on_any_data";
    case Absorbed::kByThisMotion:
      return "by_this_motion";
    default:
      return "partly";
  }
}

}  // namespace

std::string atlas_json(const AtlasReport& report) {
  Json entries = Json::array();
  for (const std::size_t place : report.order) {
    const AtlasEntry& entry = report.atlas.entries[place];
    Json json = {
        {"effect", entry.effect.law.name},
        {"family", entry.effect.law.family},
        {"joint", atlas_joint(report, place)},
        {"other_joint", entry.effect.other >= 0 ? Json(entry.effect.other + 1) : Json(nullptr)}};
    if (!entry.missing.empty()) {
      json["missing"] = entry.missing;
      entries.push_back(std::move(json));
      continue;
    }
    Json typical = Json::object();
    for (int p = 0; p < entry.effect.law.size(); ++p) {
      typical[entry.effect.law.parameters[static_cast<std::size_t>(p)].name] =
          number(entry.effect.parameters[p]);
    }
    json["typical"] = std::move(typical);
    json["absorbed"] = entry.absorbed;
    json["kind"] = absorbed_name(entry.kind);
    json["enr_before"] = number(entry.enr_before);
    json["enr_left"] = number(entry.enr_left);
    json["lambda"] = number(entry.lambda);
    json["samples_worth"] = number(entry.worth);
    json["parameter"] =
        entry.parameter >= 0
            ? Json(entry.effect.law.parameters[static_cast<std::size_t>(entry.parameter)].name)
            : Json(nullptr);
    json["smallest_detectable"] = number(entry.detectable);
    json["unit"] = report.units[place];
    Json aliases = Json::array();
    for (const std::size_t other : report.atlas.nearest(place, kAliasesInJson)) {
      const AtlasEntry& alias = report.atlas.entries[other];
      aliases.push_back(
          {{"effect", alias.effect.law.name},
           {"family", alias.effect.law.family},
           {"joint", atlas_joint(report, other)},
           {"cos", report.atlas.likeness(static_cast<Index>(place), static_cast<Index>(other))}});
    }
    json["aliases"] = std::move(aliases);
    entries.push_back(std::move(json));
  }
  const Json json = {{"schema", "dynid.atlas/1"},
                     {"robot", report.robot.linear.name},
                     {"joints", report.robot.linear.joints()},
                     {"motion", report.motion},
                     {"equations", report.equations},
                     {"row_time", report.row_time},
                     {"noise", {{"from", report.noise_from}, {"std", numbers(report.noise)}}},
                     {"effects", std::move(entries)}};
  return json.dump(2) + "\n";
}

}  // namespace dyngen::runtime
