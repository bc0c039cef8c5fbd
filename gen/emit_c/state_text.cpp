// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/state_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/emit_c/c_spelling.h"

namespace dyngen {
namespace {

std::string reset_signature(const EmitOptions& options) {
  return fmt::format("{2} void {0}_reset({0}_state *s, {1} dt)", options.prefix,
                     options.scalar == Scalar::kDouble ? "double" : "float",
                     function_macro(options));
}

std::string reset_comment(const EmitOptions& options) {
  return wrap_comment(
             fmt::format("Makes *s new: states 0, or what is nearest within their limits. The "
                         "first call after it leaves the states as they are, every further one "
                         "moves them on by dt, the time between two calls in s; {}_reset may be "
                         "called again at any time.",
                         options.prefix),
             "/* ", " * ") +
         " */\n";
}

}  // namespace

bool any_has_state(const CodeModel& code, const std::vector<RobotFunction>& functions) {
  return std::any_of(functions.begin(), functions.end(), [&](const RobotFunction& function) {
    return has_state(*function.spec, code);
  });
}

std::string state_declarations(const CodeModel& code, const EmitOptions& options) {
  const std::string upper = upper_case(options.prefix);
  const EffectMemory& memory = code.memory;
  std::string text = fmt::format("\n#define {0}_NSTATE {1} /* states of effects */\n", upper,
                                 memory.states.size());
  if (!memory.last.empty()) {
    text += fmt::format("#define {0}_NLAST {1}  /* variables that their rates read */\n", upper,
                        memory.last.size());
  }
  text += "\n/* What effects remember between two calls. */\n";
  const std::string scalar = options.scalar == Scalar::kDouble ? "double" : "float";
  text += fmt::format("typedef struct {}_state {{\n", options.prefix);
  text += fmt::format("  {0} z[{1}_NSTATE]; /* see {2}_state_names */\n", scalar, upper,
                      options.prefix);
  if (!memory.last.empty()) {
    std::string names;
    for (const RememberedVariable& last : memory.last) {
      names += fmt::format("{}{} of joint {}", names.empty() ? "" : ", ", last.variable, last.link);
    }
    text += wrap_comment(names, fmt::format("  {} last[{}_NLAST]; /* ", scalar, upper), "   * ") +
            " */\n";
  }
  text += fmt::format("  {0} step; /* s: of the next call */\n  {0} dt;   /* s: of all others */\n",
                      scalar);
  text += fmt::format("}} {}_state;\n", options.prefix);
  text += fmt::format("extern const char *const {}_state_names[];\n\n", options.prefix);
  return text + reset_comment(options) + reset_signature(options) + ";\n";
}

std::string state_definitions(const CodeModel& code, const EmitOptions& options) {
  const CSpelling spelling(options, code.inputs);
  std::string text = table_begin("char *const", "state_names", options);
  for (const CodeState& state : code.memory.states)
    text += fmt::format("    \"{}\",\n", state.name);
  text += "    0};\n\n" + reset_comment(options) + reset_signature(options) + " {\n";
  for (std::size_t i = 0; i < code.memory.states.size(); ++i) {
    text += fmt::format("  s->z[{}] = {};\n", i, spelling.number(code.memory.states[i].start));
  }
  for (std::size_t i = 0; i < code.memory.last.size(); ++i) {
    text += fmt::format("  s->last[{}] = 0;\n", i);
  }
  return text + "  s->step = 0;\n  s->dt = dt;\n}\n";
}

}  // namespace dyngen
