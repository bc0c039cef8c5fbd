// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/base_parameters/base_parameters.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;
using Inertial = std::array<ex, kInertialCount>;

Inertial zero_inertial() {
  Inertial inertial;
  inertial.fill(0);
  return inertial;
}

/// Takes from a link what its own joint cannot show: the body that the joint's motion maps to
/// itself.
Inertial take_invariant(SymbolicLink& link) {
  Inertial taken = zero_inertial();
  const auto take = [&](Chi kind) {
    taken[index(kind)] = link.chi[index(kind)];
    link.chi[index(kind)] = 0;
  };
  switch (link.type) {
    case JointType::kRevolute:
      // a body that is the same after a turn about z, with no inertia about z: XX = YY, MZ, M
      taken[index(Chi::kXX)] = link.chi[index(Chi::kYY)];
      link.chi[index(Chi::kXX)] -= link.chi[index(Chi::kYY)];
      for (const Chi kind : {Chi::kYY, Chi::kMZ, Chi::kM}) take(kind);
      break;
    case JointType::kPrismatic:
      for (const Chi kind : {Chi::kXX, Chi::kXY, Chi::kXZ, Chi::kYY, Chi::kYZ, Chi::kZZ})
        take(kind);
      break;
    case JointType::kFixed:
      for (std::size_t k = 0; k < kInertialCount; ++k) take(static_cast<Chi>(k));
      break;
  }
  return taken;
}

/// Moves what each joint cannot show to its parent, from the tips to the base. What reaches the
/// base is gone.
void group_in_closed_form(SymbolicRobot& robot, std::set<Column>& grouped) {
  for (int j = robot.size(); j >= 1; --j) {
    SymbolicLink& link = robot.link(j);
    const ex xx = link.chi[index(Chi::kXX)];
    const Inertial taken = take_invariant(link);
    if (!(link.chi[index(Chi::kXX)] - xx).expand().is_zero()) grouped.insert({j, Chi::kXX});
    if (link.parent == 0) continue;
    // the turn of a revolute joint does not matter to such a body, and along a prismatic one a
    // tensor without mass does not feel the shift: q = 0 stands for every q
    const ex theta = link.type == JointType::kRevolute ? ex(0) : link.theta;
    const ex r = link.type == JointType::kPrismatic ? ex(0) : link.r;
    const ex d = link.type == JointType::kPrismatic ? ex(0) : link.d;
    const Inertial moved = move_to_parent(taken, link.alpha, d, theta, r);
    SymbolicLink& parent = robot.link(link.parent);
    for (std::size_t k = 0; k < kInertialCount; ++k) {
      if (moved[k].is_zero()) continue;
      parent.chi[k] = drop_rounding(parent.chi[k] + moved[k]);
      grouped.insert({link.parent, static_cast<Chi>(k)});
    }
  }
}

/// Columns that the closed form leaves on a link.
std::vector<Chi> remaining_kinds(JointType type) {
  switch (type) {
    case JointType::kRevolute:
      return {Chi::kXX, Chi::kXY, Chi::kXZ, Chi::kYZ, Chi::kZZ, Chi::kMX, Chi::kMY};
    case JointType::kPrismatic:
      return {Chi::kMX, Chi::kMY, Chi::kMZ, Chi::kM};
    case JointType::kFixed:
      return {};
  }
  return {};
}

/// Removes what the limited motion near the base leaves zero or dependent.
///
/// @return columns that depend on others, but by no known function of the lengths
std::vector<Column> group_dependent(SymbolicRobot& robot, Motions motions,
                                    std::set<Column>& grouped) {
  std::vector<Column> columns;
  for (int j = 1; j <= robot.size(); ++j) {
    for (const Chi kind : remaining_kinds(robot.link(j).type)) columns.push_back({j, kind});
  }
  for (int j = 1; j <= robot.size(); ++j) {
    if (!robot.link(j).chi[index(Chi::kIA)].is_zero()) columns.push_back({j, Chi::kIA});
  }
  Dependencies dependencies = find_dependencies(robot, columns, motions);
  for (const Dependency& dependency : dependencies.found) {
    ex& value = robot.link(dependency.column.link).chi[index(dependency.column.kind)];
    if (!value.is_zero()) {
      for (const auto& [column, coefficient] : dependency.others) {
        ex& target = robot.link(column.link).chi[index(column.kind)];
        target = drop_rounding(target + coefficient * value);
        grouped.insert(column);
      }
    }
    value = 0;
  }
  return std::move(dependencies.unsolved);
}

std::vector<GroupedParameter> list_parameters(const SymbolicRobot& robot,
                                              const std::set<Column>& grouped) {
  std::vector<GroupedParameter> parameters;
  for (int j = 1; j <= robot.size(); ++j) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      const ex& value = robot.link(j).chi[k];
      if (value.is_zero()) continue;
      const Column column{j, static_cast<Chi>(k)};
      parameters.push_back({column, grouped.contains(column), value});
    }
  }
  return parameters;
}

}  // namespace

Regrouping regroup(const SymbolicRobot& robot, Motions motions) {
  Regrouping result;
  result.robot = robot;
  std::set<Column> grouped;
  group_in_closed_form(result.robot, grouped);
  result.unsolved = group_dependent(result.robot, motions, grouped);
  result.parameters = list_parameters(result.robot, grouped);
  return result;
}

Regrouping keep_standard(const SymbolicRobot& robot) {
  return {robot, list_parameters(robot, {}), {}};
}

}  // namespace dyngen
