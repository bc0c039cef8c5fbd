// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/algorithms/code_model/code_model.h"

#include <fmt/format.h>

#include <algorithm>
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

/// @param shared  one for all samples of a batch
ex add_input(SymbolTable& table, const std::string& array, int index, const std::string& suffix,
             const std::string& unit, bool shared = false) {
  SymbolInfo info;
  info.name = fmt::format("{}_{}", array == "tau" ? "tau_in" : array, suffix);
  info.kind = SymbolKind::kInput;
  info.shared = shared;
  info.unit = unit;
  info.array = array;
  info.index = index;
  return table.add(std::move(info));
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

bool is_gravity(const SymbolicRobot& robot, const ex& symbol) {
  return std::any_of(robot.gravity.begin(), robot.gravity.end(),
                     [&](const ex& component) { return component.is_equal(symbol); });
}

/// A body on the last link: its parameters add to the link's.
void add_payload(CodeModel& code) {
  CodeLink& last = code.links.back();
  std::array<ex, kInertialCount> body;
  for (std::size_t k = 0; k < kInertialCount; ++k) {
    body[k] = add_input(code.inputs, "payload", static_cast<int>(k), std::string(kChiNames[k]),
                        std::string(chi_unit(static_cast<Chi>(k), true)), true);
  }
  body = move_to_parent(body, last.tip_alpha, last.tip_d, 0, 0);
  for (std::size_t k = 0; k < kInertialCount; ++k) last.chi[k] += body[k];
}

void add_wrench(CodeModel& code) {
  std::array<ex, 6> w;  // in the file's frame
  for (std::size_t k = 0; k < w.size(); ++k) {
    w[k] = add_input(code.inputs, "wrench", static_cast<int>(k), std::to_string(k + 1),
                     k < 3 ? "N" : "N m");
  }
  const CodeLink& link = code.link(code.wrench_link());
  const ex s = add_constant(code.inputs, "SAt", exact_sin(link.tip_alpha), "", "");
  const ex c = add_constant(code.inputs, "CAt", exact_cos(link.tip_alpha), "", "");
  const ex y = c * w[1] - s * w[2], z = s * w[1] + c * w[2];
  code.wrench = {w[0],
                 y,
                 z,
                 w[3],
                 (c * w[4] - s * w[5] - link.tip_d * z).expand(),
                 (s * w[4] + c * w[5] + link.tip_d * y).expand()};
}

/// One weight for each element of the regressor in base parameters.
void add_weights(CodeModel& code) {
  const std::size_t rows = code.coordinate_names.size(), columns = code.beta.size();
  for (std::size_t k = 0; k < rows * columns; ++k) {
    code.weights.push_back(add_input(code.inputs, "A", static_cast<int>(k),
                                     fmt::format("{}_{}", k / columns + 1, k % columns + 1),
                                     "per unit of Y"));
  }
}

/// Makes the code model part by part. The order of the parts is the order of the symbols: chi comes
/// first, so that parameters lead each product.
class CodeModelMaker {
 public:
  CodeModelMaker(const Regrouping& grouping, const CodeOptions& options)
      : grouping_(grouping), robot_(grouping.robot), options_(options) {}

  CodeModel make(const std::vector<GroupedParameter>& base,
                 const std::vector<BoundEffect>& effects) {
    code_.name = robot_.name;
    code_.file_name = robot_.file_name;
    for (const GroupedParameter& parameter : base) {
      code_.beta.push_back(parameter.name());
      code_.beta_columns.push_back(parameter.column);
    }
    code_.options = options_;
    code_.wrench.fill(0);
    code_.takes_chi = options_.parameters == ParameterMode::kRuntime;
    add_links();
    for (const GroupedParameter& parameter : grouping_.parameters) add_parameter(parameter);
    add_unknown_lengths();
    add_tips();
    if (options_.payload) add_payload(code_);
    add_lengths();
    add_gravity();
    add_motion();
    if (options_.wrench) add_wrench(code_);
    if (options_.weights) add_weights(code_);
    add_effects(code_, effects, robot_);
    add_load();
    return std::move(code_);
  }

 private:
  void add_links() {
    for (const SymbolicLink& link : robot_.links) {
      CodeLink own;
      own.type = link.type;
      own.parent = link.parent;
      own.alpha = link.alpha;
      own.theta = link.theta;
      own.coordinate = link.coordinate;
      own.chi.fill(0);
      code_.links.push_back(std::move(own));
      if (link.coordinate >= 0) {
        code_.coordinate_names.push_back(link.name);
        code_.coordinate_revolute.push_back(link.type == JointType::kRevolute);
      }
    }
  }

  void add_parameter(const GroupedParameter& parameter) {
    const Column column = parameter.column;
    const bool revolute = robot_.link(column.link).type != JointType::kPrismatic;
    const ex value = with_known_values(parameter.value, robot_);
    code_.chi_columns.push_back(column);
    ChiEntry entry;
    entry.name = parameter.name();
    entry.unit = chi_unit(column.kind, revolute);
    entry.value = known_number(value);
    const FileSymbol* plain = find_symbol(robot_.parameters, parameter.value);
    entry.comment = plain != nullptr ? origin(robot_.file_name, plain->line)
                                     : "= " + formula_text(parameter.value, robot_);
    ex& target = code_.links[static_cast<std::size_t>(column.link - 1)].chi[index(column.kind)];
    if (options_.parameters == ParameterMode::kBaked && entry.value) {
      target = add_constant(code_.inputs, entry.name, *entry.value, entry.unit, entry.comment);
      code_.chi.push_back(std::move(entry));
    } else if (options_.parameters == ParameterMode::kBaked && only_geometry(value, robot_)) {
      from_geometry_.emplace_back(column, value);
      code_.chi.push_back(std::move(entry));
    } else {
      target = add_chi_entry(code_, std::move(entry));
    }
  }

  /// Lengths that the file leaves unknown are entries of chi, and parameters may read them.
  void add_unknown_lengths() {
    for (const FileSymbol& length : robot_.geometry) {
      if (options_.gravity && is_gravity(robot_, length.symbol)) continue;
      geometry_[length.symbol] = add_chi_entry(
          code_, {length.name, length.unit, origin(robot_.file_name, length.line), std::nullopt});
    }
    for (const auto& [column, value] : from_geometry_) {
      code_.links[static_cast<std::size_t>(column.link - 1)].chi[index(column.kind)] =
          value.subs(geometry_);
    }
  }

  ex length(const ex& value, const std::string& name, int line) {
    if (!is_number(value)) return value.subs(geometry_);
    return add_constant(code_.inputs, name, value, "m", origin(robot_.file_name, line));
  }

  void add_tips() {
    for (std::size_t j = 0; j < robot_.links.size(); ++j) {
      const SymbolicLink& link = robot_.links[j];
      code_.links[j].tip_alpha = link.tip_alpha;
      code_.links[j].tip_d = length(link.tip_d, fmt::format("dt{}", j + 1), link.tip_line);
    }
  }

  void add_lengths() {
    for (std::size_t j = 0; j < robot_.links.size(); ++j) {
      const SymbolicLink& link = robot_.links[j];
      code_.links[j].d = length(link.d, fmt::format("d{}", j + 1), link.d_line);
      code_.links[j].r = length(link.r, fmt::format("r{}", j + 1), link.r_line);
    }
  }

  void add_gravity() {
    constexpr std::array<const char*, 3> kGravityNames = {"GX", "GY", "GZ"};
    for (std::size_t k = 0; k < 3; ++k) {
      const ex& value = robot_.gravity[k];
      if (options_.gravity) {
        code_.gravity[k] = add_input(code_.inputs, "gravity", static_cast<int>(k),
                                     std::string(1, "xyz"[k]), "m/s^2", true);
        geometry_[value] = code_.gravity[k];
        continue;
      }
      code_.gravity[k] = is_number(value)
                             ? add_constant(code_.inputs, kGravityNames[k], value, "m/s^2",
                                            origin(robot_.file_name, robot_.gravity_lines[k]))
                             : value.subs(geometry_);
    }
  }

  void add_motion() {
    const auto add_inputs = [&](const std::string& array, ex CodeLink::*member,
                                const std::string& per_time) {
      for (int j = 1; j <= code_.size(); ++j) {
        CodeLink& link = code_.links[static_cast<std::size_t>(j - 1)];
        if (link.coordinate < 0) continue;
        const std::string unit = (link.type == JointType::kRevolute ? "rad" : "m") + per_time;
        link.*member = add_input(code_.inputs, array, link.coordinate, std::to_string(j), unit);
      }
    };
    add_inputs("q", &CodeLink::q, "");
    add_inputs("dq", &CodeLink::dq, "/s");
    add_inputs("ddq", &CodeLink::ddq, "/s^2");
    for (int j = 1; j <= code_.size(); ++j) {
      CodeLink& link = code_.links[static_cast<std::size_t>(j - 1)];
      if (link.coordinate < 0) continue;
      link.tau = add_input(code_.inputs, "tau", link.coordinate, std::to_string(j),
                           link.type == JointType::kRevolute ? "N m" : "N");
    }
  }

  /// A force and a moment on a link, of the functions that ask for them.
  void add_load() {
    for (std::size_t k = 0; k < code_.load.size(); ++k) {
      code_.load[k] = add_input(code_.inputs, "w", static_cast<int>(k), std::to_string(k + 1),
                                k < 3 ? "N" : "N m");
    }
  }

  const Regrouping& grouping_;
  const SymbolicRobot& robot_;
  const CodeOptions& options_;
  CodeModel code_;
  GiNaC::exmap geometry_;                             // unknown lengths: their entries of chi
  std::vector<std::pair<Column, ex>> from_geometry_;  // baked, but a length in it is unknown
};

}  // namespace

ex add_chi_entry(CodeModel& code, ChiEntry entry) {
  SymbolInfo info;
  info.name = entry.name;
  info.kind = SymbolKind::kParameter;
  info.unit = entry.unit;
  info.comment = entry.comment;
  info.array = "chi";
  info.index = static_cast<int>(code.chi.size());
  info.shared = true;
  code.takes_chi = true;
  code.chi.push_back(std::move(entry));
  return code.inputs.add(std::move(info));
}

CodeModel make_code_model(const Regrouping& grouping, const std::vector<GroupedParameter>& base,
                          const CodeOptions& options, const std::vector<BoundEffect>& effects) {
  return CodeModelMaker(grouping, options).make(base, effects);
}

std::vector<CodeLink> with_named_parameters(Trace& trace, const CodeModel& code) {
  std::vector<CodeLink> links = code.links;
  const auto is_sum = [](const ex& value) {
    return !value.is_zero() && !GiNaC::is_a<GiNaC::symbol>(value) && !is_number(value);
  };
  const bool any = std::any_of(links.begin(), links.end(), [&](const CodeLink& link) {
    return std::any_of(link.chi.begin(), link.chi.end(), is_sum);
  });
  if (any) trace.section("parameters that are sums");
  for (int j = 1; j <= code.size(); ++j) {
    for (std::size_t k = 0; k < kChiCount; ++k) {
      ex& value = links[static_cast<std::size_t>(j - 1)].chi[k];
      if (is_sum(value)) value = trace.assign(fmt::format("{}_{}", kChiNames[k], j), value);
    }
  }
  return links;
}

}  // namespace dyngen
