// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/explain/grouping_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// number * lengths: "2 d3 r4", "d3^2"; the powers stand in the order of the robot's lengths.
struct Factor {
  double number = 1;
  std::vector<int> powers;

  [[nodiscard]] bool is_one() const {
    return number == 1 && std::all_of(powers.begin(), powers.end(), [](int p) { return p == 0; });
  }
  auto key() const { return std::make_pair(powers, number); }
};

std::string factor_text(const Factor& factor, const SymbolicRobot& robot) {
  std::string text;
  if (factor.number != 1) text = fmt::format("{:.6g}", factor.number);
  for (std::size_t k = 0; k < factor.powers.size(); ++k) {
    const int power = factor.powers[k];
    if (power == 0) continue;
    text += (text.empty() ? "" : " ") + robot.geometry[k].name;
    if (power != 1) text += fmt::format("^{}", power);
  }
  return text;
}

/// sign * factor * (parameters)
struct Group {
  Factor factor;
  bool negative = false;
  std::vector<std::pair<std::size_t, bool>> members;  // place of the parameter, its sign
};

int power_of(const ex& term, const GiNaC::symbol& symbol) { return term.degree(symbol); }

Group split_term(const ex& term, const SymbolicRobot& robot) {
  Group group;
  ex rest = term;
  std::size_t parameter = robot.parameters.size();
  for (std::size_t k = 0; k < robot.parameters.size(); ++k) {
    if (power_of(rest, robot.parameters[k].symbol) != 1) continue;
    parameter = k;
    rest = rest.coeff(robot.parameters[k].symbol, 1);
    break;
  }
  DYNGEN_ASSERT(parameter < robot.parameters.size(), "a grouped parameter is linear");
  for (const FileSymbol& length : robot.geometry) {
    const int power = power_of(rest, length.symbol);
    group.factor.powers.push_back(power);
    rest = rest.coeff(length.symbol, power);
  }
  const double number = to_double(rest);
  group.factor.number = std::fabs(number);
  group.members.emplace_back(parameter, number < 0);
  return group;
}

/// Terms with the same factor, in the order of their first parameter; what stands alone first.
std::vector<Group> collect(const ex& value, const SymbolicRobot& robot) {
  std::vector<Group> terms;
  const ex sum = value.expand();
  if (GiNaC::is_a<GiNaC::add>(sum)) {
    for (std::size_t i = 0; i < sum.nops(); ++i) terms.push_back(split_term(sum.op(i), robot));
  } else {
    terms.push_back(split_term(sum, robot));
  }
  std::sort(terms.begin(), terms.end(), [](const Group& a, const Group& b) {
    return std::make_pair(a.members[0].first, a.factor.key()) <
           std::make_pair(b.members[0].first, b.factor.key());
  });
  std::vector<Group> groups;
  for (Group& term : terms) {
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& group) {
      return group.factor.key() == term.factor.key();
    });
    if (same == groups.end()) {
      term.negative = term.members[0].second;
      term.members[0].second = false;
      groups.push_back(std::move(term));
    } else {
      same->members.emplace_back(term.members[0].first, term.members[0].second != same->negative);
    }
  }
  std::stable_partition(groups.begin(), groups.end(),
                        [](const Group& group) { return group.factor.is_one(); });
  return groups;
}

std::string members_text(const Group& group, const SymbolicRobot& robot) {
  std::string text;
  for (const auto& [place, negative] : group.members) {
    if (!text.empty()) text += negative ? " - " : " + ";
    text += robot.parameters[place].name;
  }
  return text;
}

}  // namespace

std::string grouping_formula(const ex& value, const SymbolicRobot& robot) {
  const std::vector<Group> groups = collect(value, robot);
  std::string text;
  std::vector<bool> written(groups.size(), false);
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (written[i]) continue;
    const Group& group = groups[i];
    // (d3^2 + r3^2) (M3 + M4): the same parameters with other lengths
    std::string factors = factor_text(group.factor, robot);
    int merged = 1;
    for (std::size_t k = i + 1; k < groups.size() && !group.factor.is_one(); ++k) {
      if (written[k] || groups[k].members != group.members) continue;
      factors += (groups[k].negative != group.negative ? " - " : " + ") +
                 factor_text(groups[k].factor, robot);
      written[k] = true;
      ++merged;
    }
    std::string members = members_text(group, robot);
    if (!group.factor.is_one()) {
      if (group.members.size() > 1) members = "(" + members + ")";
      members = (merged > 1 ? "(" + factors + ")" : factors) + " " + members;
    } else if (group.negative && group.members.size() > 1) {
      members = "(" + members + ")";
    }
    if (text.empty()) {
      text = (group.negative ? "-" : "") + members;
    } else {
      text += (group.negative ? " - " : " + ") + members;
    }
  }
  return text;
}

}  // namespace dyngen
