// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/function_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/algorithms/bodies/centroid.h"
#include "gen/emit_c/body_text.h"
#include "gen/emit_c/c_spelling.h"

namespace dyngen {
namespace {

constexpr std::size_t kLineColumns = 100;

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
  if (argument.state) return fmt::format("{} what effects remember, in and out", name);
  if (name == "folded") {
    return fmt::format("folded[{}] see enum {}_folded{}", argument.size(), options.prefix,
                       argument.output ? ", out" : "");
  }
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
    return fmt::format("wrench[6] N, N m: on {}, about its origin, in its frame",
                       code.options.wrench_link > 0
                           ? fmt::format("link {}", code.options.wrench_link)
                           : "the last link");
  }
  if (name == "w") return "w[6] N, N m: on the link, about its origin, in the axes of frame 0";
  if (name == "A") {
    return fmt::format("A[{}] weights, {} x {} row-major", argument.size(), argument.rows,
                       argument.columns);
  }
  if (name == "payload") {
    return "payload[10] XX XY XZ YY YZ ZZ MX MY MZ M of a body on the last link, in its frame";
  }
  return fmt::format("{}[{}]", name, argument.size());
}

}  // namespace

namespace {

/// What of the robot's effects is in the function.
std::string effects_text(const CodeModel& code, const FunctionSpec& spec) {
  if (code.effects.empty() || spec.effects == EffectPart::kNone) return {};
  if (spec.effects == EffectPart::kLeftOut) return " The robot's effects are left out.";
  std::string names;
  for (const CodeEffect& effect : code.effects) {
    names +=
        fmt::format("{}{} of joint {}", names.empty() ? "" : ", ", effect.file->name, effect.joint);
    if (effect.other > 0) names += fmt::format(" and {}", effect.other);
  }
  std::string text = fmt::format(" Effects: {}.", names);
  if (has_state(spec, code)) {
    text += fmt::format(
        " Moves *{0} on by {0}->dt: of the functions that take it, one is called in each period.",
        kStateArgument);
  }
  return text;
}

/// Links that count as having no mass in a function of the bodies, though they have inertia.
std::string massless_text(const CodeModel& code, const FunctionSpec& spec) {
  if (spec.why_absent != why_no_centroid) return {};
  std::string links;
  for (std::size_t j = 0; j < code.bodies.links.size(); ++j) {
    const auto& body = code.bodies.links[j];
    const bool any =
        std::any_of(body.begin(), body.end(), [](const auto& v) { return !v.is_zero(); });
    if (any && body[index(Chi::kM)].is_zero()) links += fmt::format(" {}", j + 1);
  }
  return links.empty() ? "" : fmt::format(" Without mass in the robot file: links{}.", links);
}

}  // namespace

std::string summary_text(const CodeModel& code, const RobotFunction& function) {
  std::string text = std::string(function.spec->summary) + effects_text(code, *function.spec) +
                     massless_text(code, *function.spec);
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
    if (line.size() > 2 && line.size() + entry.size() > kLineColumns) {
      text += line + "\n";
      line = " *";
    }
    line += entry;
    if (argument.state) written += "*" + argument.name;
    if (argument.output) written += (written.empty() ? "" : ", ") + argument.name;
  }
  text += line + "\n";
  const OperationCount count = function.trace.count();
  text += fmt::format(
      " * {} mul, {} add, {} sin/cos, {} sgn{}{}.  Reads every input before writing {}. */\n",
      count.multiplications, count.additions, count.sin_cos_pairs, count.signs,
      count.calls > 0 ? fmt::format(", {} calls", count.calls) : "",
      count.divisions > 0 ? fmt::format(", {} div", count.divisions) : "", written);
  return text;
}

std::string signature(const CodeModel& code, const RobotFunction& function,
                      const EmitOptions& options) {
  std::string text =
      fmt::format("{} void {}_{}(", function_macro(options), options.prefix, function.name);
  bool first = true;
  for (const Argument& argument : arguments(*function.spec, code)) {
    text += (first ? "" : ", ") + declared(argument, argument.name, options);
    first = false;
  }
  return text + ")";
}

std::string function_definition(const CodeModel& code, const RobotFunction& function,
                                const EmitOptions& options) {
  const Trace& trace = function.trace;
  const std::vector<Argument> all = arguments(*function.spec, code);
  const CSpelling spelling(options, trace.symbols());
  const Body body(trace, all, options);
  std::string text = function_comment(code, function, options);
  text += wrap_arguments(signature(code, function, options) + " {\n");
  text += body.constants() + body.statements();
  if (!text.ends_with("{\n")) text += "\n";
  for (const Argument& argument : all) {
    if (argument.state) continue;
    const bool used = argument.output ? argument.size() > 0 : body.reads(argument.name);
    if (!used) {
      text += fmt::format("  (void){};\n", argument.name);
    }
  }
  for (const Output& output : trace.outputs()) {
    text += wrap_statement(fmt::format("  {} = {};", CSpelling::element(output.array, output.index),
                                       spelling.expression(output.value)));
  }
  return text + "}\n";
}

std::string passed_arguments(const CodeModel& code, const RobotFunction& function) {
  std::string text;
  for (const Argument& argument : arguments(*function.spec, code)) {
    text += (text.empty() ? "" : ", ") + argument.name;
  }
  return text;
}

std::string forwarding_definition(const CodeModel& code, const RobotFunction& function,
                                  const EmitOptions& options) {
  std::string text = function_comment(code, function, options);
  text += wrap_arguments(signature(code, function, options) + " {\n");
  text += wrap_arguments(fmt::format("  {}_{}({});\n", options.prefix, function.twin,
                                     passed_arguments(code, function)));
  return text + "}\n";
}

}  // namespace dyngen
