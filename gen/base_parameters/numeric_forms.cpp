// SPDX-License-Identifier: GPL-2.0-or-later
#include <map>
#include <utility>

#include "gen/base_parameters/base_forms.h"
#include "gen/base_parameters/numeric_regressor.h"
#include "gen/diagnostic/assert.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

SymbolicRobot with_lengths(SymbolicRobot robot, const GiNaC::exmap& lengths) {
  for (SymbolicLink& link : robot.links) {
    link.d = link.d.subs(lengths);
    link.r = link.r.subs(lengths);
  }
  for (GiNaC::ex& component : robot.gravity) component = component.subs(lengths);
  robot.geometry.clear();
  return robot;
}

cln::cl_R number(const GiNaC::ex& value) {
  const GiNaC::ex approximate = value.evalf();
  DYNGEN_ASSERT(GiNaC::is_a<GiNaC::numeric>(approximate), "a coefficient has no number");
  return cln::the<cln::cl_R>(GiNaC::ex_to<GiNaC::numeric>(approximate).to_cl_N());
}

}  // namespace

std::vector<Column> inertial_columns(const SymbolicRobot& robot) {
  std::vector<Column> columns;
  for (int j = 1; j <= robot.size(); ++j) {
    for (std::size_t k = 0; k < kInertialCount; ++k) columns.push_back({j, static_cast<Chi>(k)});
  }
  for (int j = 1; j <= robot.size(); ++j) {
    if (robot.link(j).type != JointType::kFixed) columns.push_back({j, Chi::kIA});
  }
  return columns;
}

GiNaC::exmap random_lengths(const SymbolicRobot& robot, std::uint64_t seed) {
  RandomStream random(seed);
  GiNaC::exmap lengths;
  for (const FileSymbol& entry : robot.geometry) lengths[entry.symbol] = random.next();
  return lengths;
}

BaseForms numeric_forms(const SymbolicRobot& robot, const GiNaC::exmap& lengths,
                        const std::vector<Column>& columns, Motions motions) {
  const PrecisionScope precision;
  const Dependencies dependencies =
      find_dependencies(with_lengths(robot, lengths), columns, motions);
  DYNGEN_ASSERT(dependencies.unsolved.empty(), "numbers alone leave nothing to solve for");
  std::map<Column, std::size_t> places;
  for (std::size_t k = 0; k < columns.size(); ++k) places.emplace(columns[k], k);
  NumberMatrix rows(columns.size(), std::vector<cln::cl_R>(columns.size(), cln::cl_R(0)));
  for (std::size_t k = 0; k < columns.size(); ++k) rows[k][k] = 1;
  for (const Dependency& dependency : dependencies.found) {
    const std::size_t dependent = places.at(dependency.column);
    rows[dependent][dependent] = 0;
    for (const auto& [column, coefficient] : dependency.others) {
      rows[places.at(column)][dependent] = number(coefficient);
    }
  }
  return {columns, echelon(std::move(rows), columns.size())};
}

BaseForms grouped_forms(const Regrouping& grouping, const SymbolicRobot& robot,
                        const GiNaC::exmap& lengths, const std::vector<Column>& columns) {
  const PrecisionScope precision;
  NumberMatrix rows;
  for (const GroupedParameter& parameter : grouping.parameters) {
    const GiNaC::ex value = parameter.value.expand();
    std::vector<cln::cl_R> row;
    for (const Column column : columns) {
      const GiNaC::ex& symbol = robot.link(column.link).chi[index(column.kind)];
      row.push_back(symbol.is_zero() ? cln::cl_R(0) : number(value.coeff(symbol).subs(lengths)));
    }
    rows.push_back(std::move(row));
  }
  return {columns, echelon(std::move(rows), columns.size())};
}

bool same_space(const BaseForms& a, const BaseForms& b) {
  if (a.columns != b.columns || a.forms.rank() != b.forms.rank()) return false;
  NumberMatrix rows = a.forms.rows;
  rows.insert(rows.end(), b.forms.rows.begin(), b.forms.rows.end());
  return echelon(std::move(rows), a.columns.size()).rank() == a.forms.rank();
}

}  // namespace dyngen
