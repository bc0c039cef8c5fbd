// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_script/emit_numpy.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "gen/emit_c/function_text.h"
#include "gen/emit_script/script_spelling.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

const ScriptLanguage& python() {
  static const ScriptLanguage kPython = {
      .multiply = " * ",
      .divide = " / ",
      .comment = "# ",
      .continued = " \\",
      .end_of_statement = "",
      .most_letters = 200,
      .element = [](const Argument& argument,
                    int index) { return fmt::format("{}[{}]", argument.name, index); },
      .calls = {{"sin", "np.sin"},
                {"cos", "np.cos"},
                {"sign", "np.sign"},
                {"exp", "np.exp"},
                {"log", "np.log"},
                {"tanh", "np.tanh"},
                {"abs", "np.abs"},
                {"min", "np.minimum"},
                {"max", "np.maximum"},
                {"sqrt", "np.sqrt"},
                {"pow", "np.power"},
                {"phi", "_phi"},
                {"dphi", "_dphi"}}};
  return kPython;
}

constexpr const char* kPythonHelpers = R"py(

def _given(name, value, shape, shared=False):
    """The value as an array whose first axes have this shape; one axis of elements then."""
    value = np.asarray(value)
    if value.shape[:len(shape)] != shape or (shared and value.ndim > len(shape)):
        rest = "" if shared else ", or with axes of samples behind"
        raise ValueError("%s has the shape %s, expected %s%s" % (name, value.shape, shape, rest))
    return value.reshape((-1,) + value.shape[len(shape):])


def _stacked(shape, values, *inputs):
    """The values as an array of this shape, with the axes of the inputs' samples behind."""
    samples = np.broadcast_shapes(*(x.shape[1:] for x in inputs))
    result = np.empty((len(values),) + samples, dtype=np.result_type(float, *inputs))
    for k, value in enumerate(values):
        result[k] = value
    return result.reshape(shape + samples)
)py";

constexpr const char* kPythonPhi = R"py(

def _phi(x):
    """(1 - exp(-x)) / x, 1 at 0"""
    zero = x == 0
    return np.where(zero, 1.0, -np.expm1(-x) / np.where(zero, 1.0, x))
)py";

constexpr const char* kPythonSlope = R"py(

def _dphi(x):
    """The derivative of (1 - exp(-x)) / x; its series near 0"""
    x = np.asarray(x, dtype=float)
    near = np.abs(x) <= 1.0
    small, large = np.where(near, x, 0.0), np.where(near, 2.0, x)
    total = np.zeros_like(x)
    for k in range(18, 0, -1):
        total = 1 - total * small * (k + 1) / (k * (k + 2))
    return np.where(near, -total / 2, (np.exp(-large) + np.expm1(-large) / large) / large)
)py";

std::string python_tuple(const std::string& name, const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& entry : names) list += fmt::format("\"{}\", ", entry);
  if (names.size() > 1) list.resize(list.size() - 2);
  if (names.size() == 1) list.resize(list.size() - 1);
  return wrap_script(fmt::format("{} = ({})", name, list), "    ", "");
}

std::string shape_text(int rows, int columns) {
  if (columns > 1) return fmt::format("({}, {})", rows, columns);
  return fmt::format("({},)", rows);
}

/// An output of one number has no axis of its own.
std::string output_shape(const OutputSpec& output, const CodeModel& code) {
  if (output.rows == Extent::kOne && output.columns == Extent::kOne) return "()";
  const int rows = extent_size(output.rows, code), columns = extent_size(output.columns, code);
  if (output.columns == Extent::kOne) return fmt::format("({},)", rows);
  return fmt::format("({}, {})", rows, columns);
}

std::string python_function(const CodeModel& code, const RobotFunction& function,
                            const ScriptBody& body, const std::vector<Argument>& all) {
  std::string parameters, checks, samples, shapes;
  for (const Argument& argument : all) {
    if (argument.output) continue;
    parameters += (parameters.empty() ? "" : ", ") + argument.name;
    const bool matrix = argument.columns > 1;
    const std::string shape = matrix ? fmt::format("({}, {})", argument.rows, argument.columns)
                                     : shape_text(argument.size(), 1);
    checks += fmt::format("    {0} = _given(\"{0}\", {0}, {1}{2})\n", argument.name, shape,
                          argument.shared ? ", shared=True" : "");
    shapes += fmt::format("{}{} {}", shapes.empty() ? "" : ", ", argument.name, shape);
    if (!argument.shared) samples += ", " + argument.name;
  }
  std::string results, returned;
  for (const OutputSpec& output : function.spec->outputs) {
    const std::string shape = output_shape(output, code);
    shapes += fmt::format("{}{} {}", results.empty() ? " -> " : ", ", output.array, shape);
    std::vector<std::string> values(static_cast<std::size_t>(extent_size(output.rows, code) *
                                                             extent_size(output.columns, code)),
                                    "0.0");
    for (const Output& element : function.trace.outputs()) {
      if (element.array != output.array) continue;
      values[static_cast<std::size_t>(element.index)] = body.expression(element.value);
    }
    std::string list;
    for (const std::string& value : values) list += (list.empty() ? "" : ", ") + value;
    const std::string array(output.array);
    results +=
        wrap_script(fmt::format("    {}_out = _stacked({}, [{}]{})", array, shape, list, samples),
                    "        ", "");
    returned += (returned.empty() ? "" : ", ") + array + "_out";
  }
  std::string text =
      wrap_script(fmt::format("\n\ndef {}({}):", function.name, parameters), "    ", "");
  text += script_comment("\"\"\"" + summary_text(code, function), "    ");
  text += "\n" + script_comment(shapes, "    ") + "    \"\"\"\n";
  return text + checks + body.text("    ") + results + "    return " + returned + "\n";
}

}  // namespace

std::string emit_numpy(const CodeModel& code, const std::vector<RobotFunction>& functions) {
  std::string text = fmt::format(
      "# Generated by dyngen from {}.  Do not edit: edit the robot file and run dyngen again.\n"
      "# SPDX-License-Identifier: MIT\n",
      source_name(code));
  text += script_comment(
      fmt::format("\"\"\"The dynamics of {}. Arrays of joints have the shape ({},), or axes of "
                  "samples behind it: results have them too. Angles in rad, SI units.\"\"\"",
                  code.name, code.coordinate_names.size()),
      "");
  text += "import numpy as np\n\n";
  std::vector<std::string> chi_names;
  std::string values;
  for (const ChiEntry& entry : code.chi) {
    chi_names.push_back(entry.name);
    values += (values.empty() ? "" : ", ") +
              (entry.value ? shortest_decimal(*entry.value) : std::string("np.nan"));
  }
  text += fmt::format("NQ = {}\n", code.coordinate_names.size());
  text += python_tuple("joint_names", code.coordinate_names);
  text += python_tuple("chi_names", chi_names);
  text += python_tuple("beta_names", code.beta);
  text += wrap_script(fmt::format("chi_values = np.array([{}])", values), "    ", "");
  text += kPythonHelpers;
  std::set<std::string> calls;
  std::string bodies;
  for (const RobotFunction& function : functions) {
    if (has_state(*function.spec, code)) continue;
    const std::vector<Argument> all = arguments(*function.spec, code);
    const ScriptBody body(python(), function.trace, all);
    calls.insert(body.calls().begin(), body.calls().end());
    bodies += python_function(code, function, body, all);
  }
  if (calls.contains("phi")) text += kPythonPhi;
  if (calls.contains("dphi")) text += kPythonSlope;
  return text + bodies;
}

}  // namespace dyngen
