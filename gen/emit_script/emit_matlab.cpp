// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_script/emit_matlab.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>

#include "gen/emit_c/function_text.h"
#include "gen/emit_script/script_spelling.h"
#include "gen/symbols/exact.h"
#include "gen/words/spelling.h"

namespace dyngen {
namespace {

constexpr std::size_t kMatlabNameLength = 63;  // namelengthmax

const ScriptLanguage& matlab() {
  static const ScriptLanguage kMatlab = {
      .multiply = " .* ",
      .divide = " ./ ",
      .comment = "% ",
      .continued = " ...",
      .end_of_statement = ";",
      .most_letters = kMatlabNameLength,
      .element =
          [](const Argument& argument, int index) {
            if (argument.shared) return fmt::format("{}({})", argument.name, index + 1);
            return fmt::format("{}({}, :)", argument.name, index + 1);
          },
      .calls = {{"pow", "power"}, {"phi", "local_phi"}, {"dphi", "local_dphi"}}};
  return kMatlab;
}

constexpr const char* kMatlabPhi = R"m(
function y = local_phi(x)
% (1 - exp(-x)) / x, 1 at 0
  y = ones(size(x));
  moved = x ~= 0;
  y(moved) = -expm1(-x(moved)) ./ x(moved);
end
)m";

constexpr const char* kMatlabSlope = R"m(
function y = local_dphi(x)
% The derivative of (1 - exp(-x)) / x; its series near 0
  near = abs(x) <= 1;
  small = x .* near;
  total = zeros(size(x));
  for k = 18:-1:1
    total = 1 - total .* small * (k + 1) / (k * (k + 2));
  end
  y = -total / 2;
  large = x(~near);
  y(~near) = (exp(-large) + expm1(-large) ./ large) ./ large;
end
)m";

std::string cell_text(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + ("'" + name + "'");
  return "{" + list + "}";
}

std::string matlab_function(const CodeModel& code, const RobotFunction& function,
                            const ScriptBody& body, const std::vector<Argument>& all) {
  std::string parameters, checks, sizes, shapes;
  for (const Argument& argument : all) {
    if (argument.output) continue;
    parameters += (parameters.empty() ? "" : ", ") + argument.name;
    const std::string& name = argument.name;
    const int size = argument.size();
    if (argument.shared) {
      checks += fmt::format(
          "  if numel({0}) ~= {1}, error('{0} has %d elements, expected {1}', numel({0})); end\n",
          name, size);
    } else if (argument.columns > 1) {  // row-major in the program, as in the C function
      checks += fmt::format(
          "  if size({0}, 1) ~= {1} || size({0}, 2) ~= {2}\n"
          "    error('{0} is %d x %d, expected {1} x {2}', size({0}, 1), size({0}, 2));\n  end\n"
          "  {0} = reshape(permute({0}, [2 1 3]), {3}, []);\n",
          name, argument.rows, argument.columns, size);
      sizes += fmt::format(", size({}, 2)", name);
    } else {
      checks += fmt::format(
          "  if size({0}, 1) ~= {1}, error('{0} has %d rows, expected {1}', size({0}, 1)); end\n",
          name, size);
      sizes += fmt::format(", size({}, 2)", name);
    }
    shapes += fmt::format("{}{}[{}]", shapes.empty() ? "" : "  ", name, size);
  }
  std::string returned, results;
  std::size_t outputs = 0;
  for (const OutputSpec& output : function.spec->outputs) {
    const std::string array = std::string(output.array) + "_out";
    const int rows = extent_size(output.rows, code), columns = extent_size(output.columns, code);
    const bool matrix = output.columns != Extent::kOne;
    returned += (returned.empty() ? "" : ", ") + array;
    shapes += fmt::format("{}{}", outputs == 0 ? "  ->  " : "  ", output.array);
    shapes += matrix ? fmt::format("[{} x {}]", rows, columns) : fmt::format("[{}]", rows);
    ++outputs;
    results += matrix ? fmt::format("  {} = zeros({}, {}, N);\n", array, rows, columns)
                      : fmt::format("  {} = zeros({}, N);\n", array, rows);
    for (const Output& element : function.trace.outputs()) {
      if (element.array != output.array) continue;
      const std::string place =
          matrix ? fmt::format("{}, {}", element.index / columns + 1, element.index % columns + 1)
                 : fmt::format("{}", element.index + 1);
      results += wrap_script(
          fmt::format("  {}({}, :) = {};", array, place, body.expression(element.value)), "      ",
          " ...");
    }
  }
  if (outputs > 1) returned = "[" + returned + "]";
  std::string text =
      "\n" + wrap_script(fmt::format("function {} = f_{}({})", returned, function.name, parameters),
                         "    ", " ...");
  text += script_comment(summary_text(code, function), "% ") + script_comment(shapes, "% ");
  text += checks;
  text += sizes.empty() ? "  N = 1;\n" : fmt::format("  N = max([{}]);\n", sizes.substr(2));
  return text + body.text("  ") + results + "end\n";
}

std::string name_rule(const std::string& name, bool python) {
  static constexpr std::array<std::string_view, 20> kMatlabWords = {
      "break",      "case",   "catch",    "classdef", "continue", "else",      "elseif",
      "end",        "for",    "function", "global",   "if",       "otherwise", "parfor",
      "persistent", "return", "spmd",     "switch",   "try",      "while"};
  static constexpr std::array<std::string_view, 35> kPythonWords = {
      "False", "None",     "True",  "and",    "as",   "assert", "async",  "await",    "break",
      "class", "continue", "def",   "del",    "elif", "else",   "except", "finally",  "for",
      "from",  "global",   "if",    "import", "in",   "is",     "lambda", "nonlocal", "not",
      "or",    "pass",     "raise", "return", "try",  "while",  "with",   "yield"};
  const bool taken =
      python ? std::find(kPythonWords.begin(), kPythonWords.end(), name) != kPythonWords.end()
             : std::find(kMatlabWords.begin(), kMatlabWords.end(), name) != kMatlabWords.end();
  if (taken) {
    return fmt::format("'{}' is a word of {} itself", name, python ? "Python" : "MATLAB");
  }
  const bool letter_first = python || (!name.empty() && name[0] != '_');
  if (!is_identifier(name) || !letter_first) {
    return fmt::format("'{}' is no name of a {}; expected letters, digits and '_', {} first", name,
                       python ? "Python module" : "MATLAB function",
                       python ? "no digit" : "a letter");
  }
  if (!python && name.size() > kMatlabNameLength) {
    return fmt::format("'{}' has {} characters; MATLAB reads {} at most", name, name.size(),
                       kMatlabNameLength);
  }
  return {};
}

}  // namespace

std::string why_no_matlab_name(const std::string& name) { return name_rule(name, false); }

std::string why_no_python_name(const std::string& name) { return name_rule(name, true); }

std::string emit_matlab(const CodeModel& code, const std::vector<RobotFunction>& functions,
                        const std::string& name) {
  std::string upper = name;
  std::transform(upper.begin(), upper.end(), upper.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::string text = fmt::format("function robot = {}\n", name);
  text += script_comment(
      fmt::format("{} The dynamics of {} as function handles: robot = {}; "
                  "tau = robot.id(q, dq, ddq). Arrays of joints are {} x 1, or {} x N for N "
                  "samples; matrices are rows x columns x N. Angles in rad, SI units.",
                  upper, code.name, name, code.coordinate_names.size(),
                  code.coordinate_names.size()),
      "%");
  text += fmt::format(
      "\n% Generated by dyngen from {}.  Do not edit: edit the robot file and run dyngen again.\n"
      "% SPDX-License-Identifier: MIT\n",
      source_name(code));
  std::vector<std::string> chi_names;
  std::string values;
  for (const ChiEntry& entry : code.chi) {
    chi_names.push_back(entry.name);
    values += (values.empty() ? "" : ", ") +
              (entry.value ? shortest_decimal(*entry.value) : std::string("NaN"));
  }
  text += fmt::format("  robot.nq = {};\n", code.coordinate_names.size());
  const auto add_names = [&](const char* field, const std::vector<std::string>& names) {
    text += wrap_script(fmt::format("  robot.{} = {};", field, cell_text(names)), "      ", " ...");
  };
  add_names("joint_names", code.coordinate_names);
  add_names("chi_names", chi_names);
  add_names("beta_names", code.beta);
  text += wrap_script(fmt::format("  robot.chi_values = [{}];", values), "      ", " ...");
  std::set<std::string> calls;
  std::string bodies;
  for (const RobotFunction& function : functions) {
    if (has_state(*function.spec, code)) continue;
    text += fmt::format("  robot.{0} = @f_{0};\n", function.name);
    const std::vector<Argument> all = arguments(*function.spec, code);
    const ScriptBody body(matlab(), function.trace, all);
    calls.insert(body.calls().begin(), body.calls().end());
    bodies += matlab_function(code, function, body, all);
  }
  text += "end\n" + bodies;
  if (calls.contains("phi")) text += kMatlabPhi;
  if (calls.contains("dphi")) text += kMatlabSlope;
  return text;
}

}  // namespace dyngen
