// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/code_model.h"

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <utility>

#include "gen/symbols/exact.h"
#include "gen/trace/form.h"

namespace dyngen {
namespace {

using GiNaC::ex;

/// "puma560.robot:9": without folders, since what is written must not depend on where dyngen ran.
std::string origin(const std::string& file_name, int line) {
  const std::string name = std::filesystem::path(file_name).filename().string();
  return line > 0 ? fmt::format("{}:{}", name, line) : name;
}

ex add_input(SymbolTable& table, const std::string& array, int index, int joint,
             const std::string& unit) {
  SymbolInfo info;
  info.name = fmt::format("{}_{}", array, joint);
  info.kind = SymbolKind::kInput;
  info.unit = unit;
  info.array = array;
  info.index = index;
  return table.add(std::move(info));
}

ex add_chi(CodeModel& code, ChiEntry entry) {
  SymbolInfo info;
  info.name = entry.name;
  info.kind = SymbolKind::kParameter;
  info.unit = entry.unit;
  info.comment = entry.comment;
  info.array = "chi";
  info.index = static_cast<int>(code.chi.size());
  code.takes_chi = true;
  code.chi.push_back(std::move(entry));
  return code.inputs.add(std::move(info));
}

/// Only numbers in it?
std::optional<ex> known_number(const ex& value) {
  if (is_number(value)) return value;
  return std::nullopt;
}

const FileSymbol* find_symbol(const std::vector<FileSymbol>& entries, const ex& symbol) {
  for (const FileSymbol& entry : entries) {
    if (symbol.is_equal(entry.symbol)) return &entry;
  }
  return nullptr;
}

/// True if only lengths and gravity components are unknown in it.
bool only_geometry(const ex& value, const SymbolicRobot& robot) {
  for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
    if (GiNaC::is_a<GiNaC::symbol>(*it) && find_symbol(robot.geometry, *it) == nullptr) {
      return false;
    }
  }
  return true;
}

/// A grouped parameter in the file's own, as a person writes it; cut where it gets too long to
/// read.
std::string formula_text(const ex& value, const SymbolicRobot& robot) {
  SymbolTable names;
  for (const FileSymbol& entry : robot.parameters) names.add({.name = entry.name});
  for (const FileSymbol& entry : robot.geometry) names.add({.name = entry.name});
  constexpr std::size_t kMostTerms = 12;
  Form form = canonical_form(value, names);
  const std::size_t terms = form.parts.size();
  if (terms > kMostTerms) {
    form.parts.resize(kMostTerms);
    form.negative.resize(kMostTerms);
  }
  const std::function<std::string(const Form&)> spell = [&](const Form& part) {
    if (part.kind == Form::Kind::kNumber) return fmt::format("{}", to_double(part.leaf));
    if (part.kind == Form::Kind::kSymbol) return names.info(part.leaf).name;
    return join_operands(part, spell);
  };
  std::string text = spell(form);
  if (terms > kMostTerms) text += fmt::format(" + ... ({} terms)", terms);
  return text;
}

}  // namespace

CodeModel make_code_model(const Regrouping& grouping, std::vector<std::string> beta,
                          ParameterMode mode) {
  const SymbolicRobot& robot = grouping.robot;
  CodeModel code;
  code.name = robot.name;
  code.file_name = robot.file_name;
  code.beta = std::move(beta);
  code.takes_chi = mode == ParameterMode::kRuntime;

  for (const SymbolicLink& link : robot.links) {
    CodeLink own;
    own.type = link.type;
    own.parent = link.parent;
    own.alpha = link.alpha;
    own.theta = link.theta;
    own.coordinate = link.coordinate;
    own.chi.fill(0);
    code.links.push_back(std::move(own));
    if (link.coordinate >= 0) {
      code.coordinate_names.push_back(link.name);
      code.coordinate_revolute.push_back(link.type == JointType::kRevolute);
    }
  }

  // chi first, so that parameters lead each product
  GiNaC::exmap geometry;
  std::vector<std::pair<Column, ex>> from_geometry;  // baked, but a length in it is unknown
  for (const GroupedParameter& parameter : grouping.parameters) {
    const Column column = parameter.column;
    const bool revolute = robot.link(column.link).type != JointType::kPrismatic;
    const ex value = with_known_values(parameter.value, robot);
    ChiEntry entry;
    entry.name = parameter.name();
    entry.unit = chi_unit(column.kind, revolute);
    entry.value = known_number(value);
    const FileSymbol* plain = find_symbol(robot.parameters, parameter.value);
    entry.comment = plain != nullptr ? origin(robot.file_name, plain->line)
                                     : "= " + formula_text(parameter.value, robot);
    ex& target = code.links[static_cast<std::size_t>(column.link - 1)].chi[index(column.kind)];
    if (mode == ParameterMode::kBaked && entry.value) {
      target = add_constant(code.inputs, entry.name, *entry.value, entry.unit, entry.comment);
      code.chi.push_back(std::move(entry));
    } else if (mode == ParameterMode::kBaked && only_geometry(value, robot)) {
      from_geometry.emplace_back(column, value);
      code.chi.push_back(std::move(entry));
    } else {
      target = add_chi(code, std::move(entry));
    }
  }
  for (const FileSymbol& length : robot.geometry) {
    geometry[length.symbol] = add_chi(
        code, {length.name, length.unit, origin(robot.file_name, length.line), std::nullopt});
  }
  for (const auto& [column, value] : from_geometry) {
    code.links[static_cast<std::size_t>(column.link - 1)].chi[index(column.kind)] =
        value.subs(geometry);
  }

  for (std::size_t j = 0; j < robot.links.size(); ++j) {
    const SymbolicLink& link = robot.links[j];
    const auto length = [&](const ex& value, const char* name, int line) {
      if (!is_number(value)) return value.subs(geometry);
      return add_constant(code.inputs, fmt::format("{}{}", name, j + 1), value, "m",
                          origin(robot.file_name, line));
    };
    code.links[j].d = length(link.d, "d", link.d_line);
    code.links[j].r = length(link.r, "r", link.r_line);
  }
  constexpr std::array<const char*, 3> kGravityNames = {"GX", "GY", "GZ"};
  for (std::size_t k = 0; k < 3; ++k) {
    const ex& value = robot.gravity[k];
    code.gravity[k] = is_number(value)
                          ? add_constant(code.inputs, kGravityNames[k], value, "m/s^2",
                                         origin(robot.file_name, robot.gravity_lines[k]))
                          : value.subs(geometry);
  }
  const auto add_inputs = [&](const std::string& array, ex CodeLink::*member,
                              const std::string& per_time) {
    for (int j = 1; j <= code.size(); ++j) {
      CodeLink& link = code.links[static_cast<std::size_t>(j - 1)];
      if (link.coordinate < 0) continue;
      const std::string unit = (link.type == JointType::kRevolute ? "rad" : "m") + per_time;
      link.*member = add_input(code.inputs, array, link.coordinate, j, unit);
    }
  };
  add_inputs("q", &CodeLink::q, "");
  add_inputs("dq", &CodeLink::dq, "/s");
  add_inputs("ddq", &CodeLink::ddq, "/s^2");
  return code;
}

}  // namespace dyngen
