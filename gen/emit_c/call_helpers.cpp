// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/call_helpers.h"

#include <fmt/format.h>

#include <array>

#include "gen/emit_c/c_spelling.h"

namespace dyngen {
namespace {

struct Helper {
  const char* call;
  const char*
      text;  ///< {0} is the scalar, {1} the prefix, {2} "f" for float, {3} the macro of helpers
};

constexpr std::array<Helper, 5> kHelpers = {{
    {"sign", R"(/* -1, 0 or 1 */
{3} {0} {1}_sign({0} x) {{
  return ({0})((x > 0) - (x < 0));
}}

)"},
    {"min", R"({3} {0} {1}_min({0} x, {0} y) {{
  return x < y ? x : y;
}}

)"},
    {"max", R"({3} {0} {1}_max({0} x, {0} y) {{
  return x > y ? x : y;
}}

)"},
    {"phi", R"(/* (1 - exp(-x)) / x, 1 at 0 */
{3} {0} {1}_phi({0} x) {{
  return x == 0 ? 1 : -expm1{2}(-x) / x;
}}

)"},
    {"dphi", R"(/* The derivative of (1 - exp(-x)) / x; its series near 0 */
{3} {0} {1}_dphi({0} x) {{
  {0} sum = 0;
  int k;
  if (x < -1 || x > 1) return (exp{2}(-x) + expm1{2}(-x) / x) / x;
  for (k = 18; k >= 1; --k) sum = 1 - sum * x * ({0})(k + 1) / ({0})(k * (k + 2));
  return -sum / 2;
}}

)"},
}};

}  // namespace

bool is_helper_call(const std::string& call) {
  for (const Helper& helper : kHelpers) {
    if (helper.call == call) return true;
  }
  return false;
}

std::string c_library_name(const std::string& call, Scalar scalar) {
  return (call == "abs" ? "fabs" : call) + (scalar == Scalar::kFloat ? "f" : "");
}

std::string call_helpers(const std::set<std::string>& calls, const EmitOptions& options) {
  const bool single = options.scalar == Scalar::kFloat;
  std::string text;
  for (const Helper& helper : kHelpers) {
    const std::string call = helper.call;
    // lanes have a way of their own to take signs and to choose
    const bool by_lanes = (call == "phi" || call == "dphi") && calls.contains(call + "_lanes");
    if (!calls.contains(call) && !by_lanes) continue;
    text += fmt::format(fmt::runtime(helper.text), single ? "float" : "double", options.prefix,
                        single ? "f" : "", helper_macro(options));
  }
  return text;
}

}  // namespace dyngen
