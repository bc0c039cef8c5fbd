// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/function_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "gen/emit_c/c_spelling.h"
#include "gen/emit_c/inline_trig.h"

namespace dyngen {
namespace {

constexpr std::size_t kColumns = 100;

/// What one function reads, found in its statements.
struct Reads {
  std::set<std::string> arrays;   // "q", "chi"
  std::set<int> constant_places;  // named numbers
};

Reads find_reads(const Trace& trace) {
  Reads reads;
  const auto visit = [&](const GiNaC::ex& value) {
    for (auto it = value.preorder_begin(); it != value.preorder_end(); ++it) {
      if (!GiNaC::is_a<GiNaC::symbol>(*it)) continue;
      const SymbolInfo& info = trace.symbols().info(*it);
      if (info.kind == SymbolKind::kConstant) {
        reads.constant_places.insert(trace.symbols().place(*it));
      } else if (!info.array.empty()) {
        reads.arrays.insert(info.array);
      }
    }
  };
  for (const Assignment& assignment : trace.assignments()) visit(assignment.value);
  for (const Output& output : trace.outputs()) visit(output.value);
  return reads;
}

/// "q[6] rad" with the joints that differ: "q[4] rad (m: 3)".
std::string array_legend(const CodeModel& code, std::string_view array, const char* revolute_unit,
                         const char* prismatic_unit) {
  std::string prismatic;
  for (std::size_t i = 0; i < code.coordinate_revolute.size(); ++i) {
    if (!code.coordinate_revolute[i]) prismatic += fmt::format(" {}", i);
  }
  const std::size_t n = code.coordinate_revolute.size();
  if (prismatic.empty()) return fmt::format("{}[{}] {}", array, n, revolute_unit);
  return fmt::format("{}[{}] {} ({} at{})", array, n, revolute_unit, prismatic_unit, prismatic);
}

/// What an argument holds: "q[6] rad", "M[36] kg m^2, 6 x 6 row-major, out".
std::string argument_legend(const CodeModel& code, const FunctionSpec& spec,
                            const Argument& argument, const EmitOptions& options) {
  const std::string& name = argument.name;
  const auto joints = [&](const char* revolute, const char* prismatic) {
    return array_legend(code, name, revolute, prismatic);
  };
  if (argument.output) {
    const auto output = std::find_if(spec.outputs.begin(), spec.outputs.end(),
                                     [&](const OutputSpec& entry) { return entry.array == name; });
    if (output->unit.empty()) return joints("N m", "N") + ", out";
    std::string text = fmt::format("{}[{}] {}", name, argument.size(), output->unit);
    if (argument.rows > 1 && argument.columns > 1) {
      text += fmt::format(", {} x {} row-major", argument.rows, argument.columns);
    }
    return text + ", out";
  }
  if (name == "q") return joints("rad", "m");
  if (name == "dq") return joints("rad/s", "m/s");
  if (name == "ddq") return joints("rad/s^2", "m/s^2");
  if (name == "tau") return joints("N m", "N");
  if (name == "chi") return fmt::format("chi[{}] see enum {}_chi", argument.size(), options.prefix);
  if (name == "gravity") return "gravity[3] m/s^2: acceleration of the base, -g, in frame 0";
  if (name == "wrench") {
    return "wrench[6] N, N m: on the last link, about its origin, in its frame";
  }
  if (name == "payload") {
    return "payload[10] XX XY XZ YY YZ ZZ MX MY MZ M of a body on the last link, in its frame";
  }
  return fmt::format("{}[{}]", name, argument.size());
}

std::string constants(const Trace& trace, const Reads& reads, const CSpelling& spelling) {
  std::string text;
  const auto add = [&](const SymbolInfo& info) {
    if (!reads.constant_places.contains(trace.symbols().place(info.symbol))) return;
    std::string comment = info.unit;
    const bool formula = info.comment.starts_with("=");  // it stands in the enum of chi
    const std::string origin = formula ? "grouped" : info.comment;
    if (!origin.empty()) comment += (comment.empty() ? "" : ", ") + origin;
    text += fmt::format("  const {} {} = {};", spelling.scalar(), info.name,
                        spelling.number(info.value));
    text += comment.empty() ? "\n" : fmt::format(" /* {} */\n", comment);
  };
  if (trace.symbols().parent() != nullptr) {
    for (const SymbolInfo& info : trace.symbols().parent()->own()) add(info);
  }
  for (const SymbolInfo& info : trace.symbols().own()) add(info);
  return text;
}

std::string statement(const Assignment& assignment, const CSpelling& spelling) {
  return wrap_statement(fmt::format("  const {} {} = {};", spelling.scalar(),
                                    spelling.symbol(assignment.target),
                                    spelling.expression(assignment.value)));
}

/// The sines and cosines of all angles at once, before everything else: angles depend on inputs
/// alone.
std::string gathered_angles(const Trace& trace, const std::vector<GiNaC::ex>& angles,
                            const CSpelling& spelling, const EmitOptions& options) {
  std::string text;
  std::vector<std::string> names;
  for (const GiNaC::ex& angle : angles) {
    names.push_back(spelling.symbol(angle));
    for (const Assignment& assignment : trace.assignments()) {
      if (angle.is_equal(assignment.target)) text += statement(assignment, spelling);
    }
  }
  return text + sincos_calls(names, options.prefix);
}

}  // namespace

bool reads_sign(const Trace& trace) {
  for (const Assignment& assignment : trace.assignments()) {
    for (auto it = assignment.value.preorder_begin(); it != assignment.value.preorder_end(); ++it) {
      if (GiNaC::is_a<GiNaC::function>(*it) &&
          GiNaC::ex_to<GiNaC::function>(*it).get_name() == "csgn") {
        return true;
      }
    }
  }
  return false;
}

std::string summary_text(const CodeModel& code, const RobotFunction& function) {
  std::string text(function.spec->summary);
  if (!function.spec->of_link()) return text;
  const int link = parse_function_name(function.name).link;
  return text + fmt::format(" The link: {}.", link == 0 ? code.size() : link);
}

std::string function_comment(const CodeModel& code, const RobotFunction& function,
                             const EmitOptions& options) {
  const FunctionSpec& spec = *function.spec;
  std::string text = wrap_comment(summary_text(code, function), "/* ", " * ") + "\n";
  std::string written;
  std::string line = " *";
  for (const Argument& argument : arguments(spec, code)) {
    const std::string entry = "   " + argument_legend(code, spec, argument, options);
    if (line.size() > 2 && line.size() + entry.size() > kColumns) {
      text += line + "\n";
      line = " *";
    }
    line += entry;
    if (argument.output) written += (written.empty() ? "" : ", ") + argument.name;
  }
  text += line + "\n";
  const OperationCount count = function.trace.count();
  text += fmt::format(
      " * {} mul, {} add, {} sin/cos, {} sgn{}.  Reads every input before writing {}. */\n",
      count.multiplications, count.additions, count.sin_cos_pairs, count.signs,
      count.divisions > 0 ? fmt::format(", {} div", count.divisions) : "", written);
  return text;
}

std::string signature(const CodeModel& code, const RobotFunction& function,
                      const EmitOptions& options) {
  const char* scalar = options.scalar == Scalar::kDouble ? "double" : "float";
  std::string text = fmt::format("void {}_{}(", options.prefix, function.name);
  bool first = true;
  for (const Argument& argument : arguments(*function.spec, code)) {
    text += fmt::format("{}{}{} *{}", first ? "" : ", ", argument.output ? "" : "const ", scalar,
                        argument.name);
    first = false;
  }
  return text + ")";
}

std::string function_definition(const CodeModel& code, const RobotFunction& function,
                                const EmitOptions& options) {
  const Trace& trace = function.trace;
  const Reads reads = find_reads(trace);
  const CSpelling spelling(options, trace.symbols());
  std::string text = function_comment(code, function, options);
  text += wrap_arguments(signature(code, function, options) + " {\n");
  text += constants(trace, reads, spelling);

  std::vector<GiNaC::ex> angles;
  if (options.trig == Trig::kInline) angles = find_angles(trace);
  if (!angles.empty()) {
    text += "\n  /* sines and cosines of the joint angles */\n";
    text += gathered_angles(trace, angles, spelling, options);
  }
  int section = 0;
  for (const Assignment& assignment : trace.assignments()) {
    if (is_one_of(angles, assignment.target)) continue;
    const std::string gathered = gathered_value(assignment.value, angles, options.prefix);
    if (assignment.section != section && !gathered.empty()) section = assignment.section;
    if (assignment.section != section) {
      section = assignment.section;
      const std::string& title = trace.sections()[static_cast<std::size_t>(section)];
      text += "\n" + wrap_comment(title, "  /* ", "   * ") + " */\n";
    }
    text += gathered.empty() ? statement(assignment, spelling)
                             : fmt::format("  const {} {} = {};\n", spelling.scalar(),
                                           spelling.symbol(assignment.target), gathered);
  }
  if (!text.ends_with("{\n")) text += "\n";
  for (const Argument& argument : arguments(*function.spec, code)) {
    if (argument.output || reads.arrays.contains(argument.name)) continue;
    text += fmt::format("  (void){};\n", argument.name);
  }
  for (const Output& output : trace.outputs()) {
    text += wrap_statement(fmt::format("  {}[{}] = {};", output.array, output.index,
                                       spelling.expression(output.value)));
  }
  return text + "}\n";
}

}  // namespace dyngen
