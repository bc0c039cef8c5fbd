// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/explain/visibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// How a link can move, from the joints that carry it.
struct Mobility {
  bool moves = false;
  bool turns = false;
  bool one_axis = true;      // all axes that turn it are parallel to its own z
  bool origin_fixed = true;  // the origin of its frame stays where it is
};

std::vector<Mobility> mobilities(const SymbolicRobot& robot) {
  std::vector<Mobility> links(robot.links.size() + 1);
  for (int j = 1; j <= robot.size(); ++j) {
    const SymbolicLink& link = robot.link(j);
    const Mobility& parent = links[static_cast<std::size_t>(link.parent)];
    Mobility& own = links[static_cast<std::size_t>(j)];
    own = parent;
    const bool parallel = is_zero_number(GiNaC::sin(link.alpha));
    const bool beside_axis =
        parent.turns && (!link.d.is_zero() || (!parallel && !link.r.is_zero()) || !parent.one_axis);
    if (beside_axis) own.origin_fixed = false;
    if (parent.turns && !parallel) own.one_axis = false;
    if (link.type == JointType::kRevolute) own.moves = own.turns = true;
    if (link.type == JointType::kPrismatic) {
      own.moves = true;
      own.origin_fixed = false;
    }
  }
  return links;
}

std::string reason(Chi kind, int j, const Mobility& mobility) {
  const bool tensor = kind <= Chi::kZZ;
  const bool moment = kind == Chi::kMX || kind == Chi::kMY || kind == Chi::kMZ;
  if (!mobility.moves) return fmt::format("link {} stands still on the base", j);
  if (!mobility.turns) {
    return tensor || moment ? fmt::format("link {} does not turn", j)
                            : fmt::format("no force along its motion contains it", j);
  }
  if (mobility.one_axis && tensor) {
    return fmt::format("link {} turns about z{} only, which ZZ{} alone resists", j, j, j);
  }
  if (mobility.one_axis && kind == Chi::kMZ) {
    return fmt::format("link {} turns about z{} only: what lies along z{} has no arm", j, j, j);
  }
  if (mobility.origin_fixed && kind == Chi::kM) {
    return fmt::format("the origin O{} stays where it is: a mass there neither moves nor falls", j);
  }
  if (mobility.origin_fixed && moment) {
    return fmt::format("O{} stays where it is, and gravity has no moment about z{}", j, j);
  }
  return "no motion changes a torque through it";
}

/// Kind and link of a parameter of the file, from its name: "XX12".
std::pair<Chi, int> place_of(const FileSymbol& parameter) {
  const std::size_t digits = parameter.name.find_first_of("0123456789");
  const std::string kind = parameter.name.substr(0, digits);
  const auto it = std::find(kChiNames.begin(), kChiNames.end(), kind);
  return {static_cast<Chi>(it - kChiNames.begin()), std::stoi(parameter.name.substr(digits))};
}

}  // namespace

Visibility visibility(const SymbolicRobot& robot, const Regrouping& base) {
  const std::vector<Mobility> links = mobilities(robot);
  Visibility result;
  for (const FileSymbol& parameter : robot.parameters) {
    std::vector<std::string> names;
    bool alone = false;
    for (const GroupedParameter& entry : base.parameters) {
      if (!entry.value.has(parameter.symbol)) continue;
      names.push_back(entry.name());
      alone = is_number(entry.value / parameter.symbol);
    }
    if (names.size() == 1 && alone) {
      result.alone.push_back(parameter.name);
    } else if (!names.empty()) {
      result.in_sums.push_back({parameter.name, std::move(names)});
    } else {
      const auto [kind, j] = place_of(parameter);
      const std::string why = reason(kind, j, links[static_cast<std::size_t>(j)]);
      if (result.hidden.empty() || result.hidden.back().reason != why) {
        result.hidden.push_back({{}, why});
      }
      result.hidden.back().names.push_back(parameter.name);
    }
  }
  return result;
}

}  // namespace dyngen
