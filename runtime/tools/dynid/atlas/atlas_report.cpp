// SPDX-License-Identifier: MIT
#include "runtime/tools/dynid/atlas/atlas_report.h"

#include <fmt/format.h>

#include <cmath>

namespace dyngen::runtime {
namespace {

using Eigen::Index;

constexpr std::size_t kAliases = 2;  // in the table

std::string absorbed_text(const AtlasEntry& entry) {
  switch (entry.kind) {
    case Absorbed::kOnAnyData:
      return "all, on any data";
    case Absorbed::kByThisMotion:
      return "all, on this motion";
    default:
      return fmt::format("{:.2f} %", 100 * entry.absorbed);
  }
}

std::string row(const AtlasReport& report, std::size_t place) {
  const AtlasEntry& entry = report.atlas.entries[place];
  if (!entry.missing.empty()) return fmt::format("{:<32}  {}\n", entry.name, entry.missing);
  std::string text =
      fmt::format("{:<32}{:>20}{:>10.3g}", entry.name, absorbed_text(entry), entry.enr_before);
  // what rounding left of a theorem is no number
  const bool left = entry.kind == Absorbed::kPartly;
  text += left ? fmt::format("{:>10.3g}{:>11.4g}", entry.enr_left, entry.lambda)
               : fmt::format("{:>10}{:>11}", "0", "0");
  if (left) {
    text += fmt::format(
        "  {:<26}",
        fmt::format("{} {:.3g} {}",
                    entry.effect.law.parameters[static_cast<std::size_t>(entry.parameter)].name,
                    entry.detectable, report.units[place] == "1" ? "" : report.units[place]));
  } else {
    text += fmt::format("  {:<26}", "never");
  }
  std::string aliases;
  for (const std::size_t other : report.atlas.nearest(place, kAliases)) {
    const double likeness =
        report.atlas.likeness(static_cast<Index>(place), static_cast<Index>(other));
    if (likeness < kLeastLikeness) continue;
    aliases += fmt::format("{}{} {:.2f}", aliases.empty() ? "" : ", ",
                           report.atlas.entries[other].name, likeness);
  }
  text += " " + aliases;
  while (text.back() == ' ') text.pop_back();
  return text + "\n";
}

}  // namespace

int atlas_joint(const AtlasReport& report, std::size_t entry) {
  return report.atlas.entries[entry].effect.link;
}

std::string atlas_table(const AtlasReport& report) {
  std::string text = fmt::format(
      "{}: {} joints, {} base parameters; {}; {} equations a joint, one every {:.3g} ms\n",
      report.robot.linear.name, report.robot.linear.joints(), report.robot.linear.size(),
      report.motion, report.equations, 1e3 * report.row_time);
  text += "noise: " + report.noise_from + ":";
  for (Index j = 0; j < report.noise.size(); ++j) {
    text += fmt::format(" {:.3g}{}", report.noise[j],
                        report.robot.linear.revolute[static_cast<std::size_t>(j)] ? " N m" : " N");
  }
  text += "\n";
  int joint = -1;
  for (const std::size_t place : report.order) {
    if (atlas_joint(report, place) != joint) {
      joint = atlas_joint(report, place);
      text +=
          fmt::format("\n{:<32}{:>20}{:>10}{:>10}{:>11}  {:<26} {}\n",
                      joint == 0 ? "the whole robot" : fmt::format("joint {}", joint), "absorbed",
                      "ENR", "left", "lambda", "smallest detectable", "nearest aliases");
    }
    text += row(report, place);
  }
  return text;
}

HeatMap atlas_picture(const AtlasReport& report) {
  std::vector<Index> shown;
  HeatMap map;
  map.title =
      fmt::format("{}: |cos| between what a refit leaves of two effects", report.robot.linear.name);
  for (const std::size_t place : report.order) {
    const AtlasEntry& entry = report.atlas.entries[place];
    if (!entry.missing.empty() || entry.kind != Absorbed::kPartly) continue;
    shown.push_back(static_cast<Index>(place));
    map.names.push_back(entry.name);
  }
  map.values = report.atlas.likeness(shown, shown);
  return map;
}

}  // namespace dyngen::runtime
