// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/function_text.h"

#include <fmt/format.h>

#include <set>

#include "gen/emit_c/c_spelling.h"
#include "gen/emit_c/inline_trig.h"

namespace dyngen {
namespace {

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
  return text + sincos_call(names, options.prefix);
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

std::string function_comment(const CodeModel& code, const RobotFunction& function,
                             const EmitOptions& options) {
  const FunctionSpec& spec = *function.spec;
  std::string text = wrap_comment(std::string(spec.summary), "/* ", " * ") + "\n";
  std::string arguments;
  for (const std::string_view input : spec.inputs) {
    const bool q = input == "q", dq = input == "dq";
    arguments += array_legend(code, input,
                              q    ? "rad"
                              : dq ? "rad/s"
                                   : "rad/s^2",
                              q    ? "m"
                              : dq ? "m/s"
                                   : "m/s^2") +
                 "   ";
  }
  if (code.takes_chi) {
    arguments += fmt::format("chi[{}] see enum {}_chi   ", code.chi.size(), options.prefix);
  }
  arguments += array_legend(code, spec.output, "N m", "N") + ", out";
  text += " *   " + arguments + "\n";
  const OperationCount count = function.trace.count();
  text += fmt::format(
      " * {} mul, {} add, {} sin/cos, {} sgn.  Reads every input before writing {}. */\n",
      count.multiplications, count.additions, count.sin_cos_pairs, count.signs, spec.output);
  return text;
}

std::string signature(const CodeModel& code, const FunctionSpec& spec, const EmitOptions& options) {
  const char* scalar = options.scalar == Scalar::kDouble ? "double" : "float";
  std::string text = fmt::format("void {}_{}(", options.prefix, spec.name);
  for (const std::string_view input : spec.inputs) {
    text += fmt::format("const {} *{}, ", scalar, input);
  }
  if (code.takes_chi) text += fmt::format("const {} *chi, ", scalar);
  return text + fmt::format("{} *{})", scalar, spec.output);
}

std::string function_definition(const CodeModel& code, const RobotFunction& function,
                                const EmitOptions& options) {
  const Trace& trace = function.trace;
  const Reads reads = find_reads(trace);
  const CSpelling spelling(options, trace.symbols());
  std::string text = function_comment(code, function, options);
  text += wrap_arguments(signature(code, *function.spec, options) + " {\n");
  text += constants(trace, reads, spelling);

  std::vector<GiNaC::ex> angles;
  if (options.trig == Trig::kInline) angles = find_angles(trace);
  if (!angles.empty()) {
    text += "\n  /* sines and cosines of the joint angles */\n";
    text += gathered_angles(trace, angles, spelling, options);
  }
  int section = angles.empty() ? 0 : 1;  // the first section holds the angles
  for (const Assignment& assignment : trace.assignments()) {
    if (is_one_of(angles, assignment.target)) continue;
    if (assignment.section != section) {
      section = assignment.section;
      const std::string& title = trace.sections()[static_cast<std::size_t>(section)];
      text += "\n" + wrap_comment(title, "  /* ", "   * ") + " */\n";
    }
    const std::string gathered = gathered_value(assignment.value, angles);
    text += gathered.empty() ? statement(assignment, spelling)
                             : fmt::format("  const {} {} = {};\n", spelling.scalar(),
                                           spelling.symbol(assignment.target), gathered);
  }
  if (!text.ends_with("{\n")) text += "\n";
  for (const std::string_view input : function.spec->inputs) {
    if (!reads.arrays.contains(std::string(input))) text += fmt::format("  (void){};\n", input);
  }
  if (code.takes_chi && !reads.arrays.contains("chi")) text += "  (void)chi;\n";
  for (const Output& output : trace.outputs()) {
    text += wrap_statement(fmt::format("  {}[{}] = {};", output.array, output.index,
                                       spelling.expression(output.value)));
  }
  return text + "}\n";
}

}  // namespace dyngen
