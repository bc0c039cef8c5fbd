// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/batch_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/emit_c/body_text.h"
#include "gen/emit_c/c_spelling.h"
#include "gen/emit_c/function_text.h"

namespace dyngen {
namespace {

std::string scalar_name(const EmitOptions& options) {
  return options.scalar == Scalar::kDouble ? "double" : "float";
}

/// "tau", "tau + n", "tau + 2 * n": where a row begins.
std::string row(const std::string& array, int index) {
  if (index == 0) return array;
  if (index == 1) return array + " + n";
  return fmt::format("{} + {} * n", array, index);
}

/// The name under which P_id_lanes() takes an array: the array itself is in lanes there.
std::string place(const Argument& argument) {
  return argument.output || argument.shared ? argument.name : argument.name + "_at";
}

std::string lanes_function(const CodeModel& code, const RobotFunction& function,
                           const EmitOptions& options) {
  const std::vector<Argument> all = arguments(*function.spec, code);
  const Body body(function.trace, all, options, Body::Width::kLanes);
  std::string parameters, loads;
  for (const Argument& argument : all) {
    parameters += ", " + declared(argument, place(argument), options);
    if (argument.output) continue;
    if (!body.reads(argument.name)) {
      loads += fmt::format("  (void){};\n", place(argument));
    } else if (!argument.shared) {
      std::string list;
      for (int i = 0; i < argument.size(); ++i) {
        list += fmt::format("{}{}_load({})", i > 0 ? ", " : "", options.prefix,
                            row(place(argument), i));
      }
      loads += wrap_list(fmt::format("  const {}_lanes {}[{}] = {{", options.prefix, argument.name,
                                     argument.size()),
                         list + "};");
    }
  }
  std::string text = wrap_arguments(
      fmt::format("{0}_HELPER {0}_NOINLINE void {1}_{2}_lanes(size_t n{3}) {{\n",
                  upper_case(options.prefix), options.prefix, function.name, parameters));
  const bool reads_rows = std::any_of(all.begin(), all.end(), [&](const Argument& argument) {
    const bool used = argument.output || body.reads(argument.name);
    return used && !argument.shared && argument.size() > 1;
  });
  if (!reads_rows) text += "  (void)n;\n";
  text += loads + body.constants() + body.statements() + "\n";
  for (const Output& output : function.trace.outputs()) {
    const std::string value = body.expression(output.value);
    text += wrap_statement(fmt::format(
        "  {0}_store({1}, {2});", options.prefix, row(output.array, output.index),
        body.varies(output.value) ? value : fmt::format("{}_spread({})", options.prefix, value)));
  }
  return text + "}\n";
}

}  // namespace

std::string batch_signature(const CodeModel& code, const RobotFunction& function,
                            const EmitOptions& options) {
  std::string text = fmt::format("{} void {}_{}_batch(size_t n", function_macro(options),
                                 options.prefix, function.name);
  for (const Argument& argument : arguments(*function.spec, code)) {
    text += ", " + declared(argument, argument.name, options);
  }
  return text + ")";
}

std::string batch_comment(const CodeModel& code, const RobotFunction& function,
                          const EmitOptions& options) {
  std::string first, shared;
  for (const Argument& argument : arguments(*function.spec, code)) {
    if (argument.shared) {
      shared += (shared.empty() ? "" : ", ") + argument.name;
    } else if (first.empty()) {
      first = argument.name;
    }
  }
  std::string text =
      fmt::format("{}_{} of n samples: {}[i * n + k] is element i of sample k, and so on.",
                  options.prefix, function.name, first);
  if (!shared.empty()) text += fmt::format(" All samples have the same {}.", shared);
  return wrap_comment(text, "/* ", " * ") + " */\n";
}

bool writes_constant(const CodeModel& code, const RobotFunction& function,
                     const EmitOptions& options) {
  const std::vector<Argument> all = arguments(*function.spec, code);
  const Body body(function.trace, all, options, Body::Width::kLanes);
  const auto& outputs = function.trace.outputs();
  return std::any_of(outputs.begin(), outputs.end(),
                     [&](const Output& output) { return !body.varies(output.value); });
}

std::string batch_definition(const CodeModel& code, const RobotFunction& function,
                             const EmitOptions& options) {
  const std::string upper = upper_case(options.prefix);
  std::string whole, last, arrays, fill, take;
  for (const Argument& argument : arguments(*function.spec, code)) {
    const std::string& name = argument.name;
    whole += ", " + name + (argument.shared ? "" : " + k");
    last += ", " + name + (argument.shared ? "" : "_last");
    if (argument.shared) continue;
    arrays += fmt::format("    {} {}_last[{} * {}_LANES];\n", scalar_name(options), name,
                          std::max(argument.size(), 1), upper);
    const auto copy = [&](const char* how, const std::string& from, const std::string& to) {
      return fmt::format("    {}_{}(n - k, n, {}, {}, {});\n", options.prefix, how, argument.size(),
                         from, to);
    };
    if (argument.output) {
      take += copy("take", name + "_last", name + " + k");
    } else {
      fill += copy("fill_up", name + " + k", name + "_last");
    }
  }
  std::string text = lanes_function(code, function, options) + "\n";
  text += batch_comment(code, function, options);
  text += wrap_arguments(batch_signature(code, function, options) + " {\n");
  text += fmt::format("  size_t k = 0;\n  for (; n - k >= {0}_LANES; k += {0}_LANES) {{\n", upper);
  text +=
      wrap_arguments(fmt::format("    {}_{}_lanes(n{});\n", options.prefix, function.name, whole));
  text += "  }\n  if (k < n) {\n" + arrays + fill;
  text += wrap_arguments(
      fmt::format("    {}_{}_lanes({}_LANES{});\n", options.prefix, function.name, upper, last));
  return text + take + "  }\n}\n";
}

std::string batch_forwarding_definition(const CodeModel& code, const RobotFunction& function,
                                        const EmitOptions& options) {
  std::string text = batch_comment(code, function, options);
  text += wrap_arguments(batch_signature(code, function, options) + " {\n");
  text += wrap_arguments(fmt::format("  {}_{}_batch(n, {});\n", options.prefix, function.twin,
                                     passed_arguments(code, function)));
  return text + "}\n";
}

}  // namespace dyngen
