// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/lanes.h"

#include <fmt/format.h>

#include "gen/emit_c/c_spelling.h"
#include "gen/emit_c/call_helpers.h"

namespace dyngen {
namespace {

// {0} is the prefix, {1} the prefix in capitals, {2} the scalar.
constexpr const char* kPack =
    R"(/* As many doubles as one register holds, where the compiler has GNU C vectors; else one number. */
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__aarch64__)) && !defined({1}_DEVICE)
#define {1}_VECTORS
#if defined(__AVX512F__)
#define {1}_PACK 8
#elif defined(__AVX2__)
#define {1}_PACK 4
#else
#define {1}_PACK 2
#endif
#define {1}_NOINLINE __attribute__((noinline))
#define {1}_INLINE inline __attribute__((always_inline, unused))
#define {1}_AT(x, i) x[(i) / {1}_PACK][(i) % {1}_PACK]
typedef double {0}_pack __attribute__((vector_size(8 * {1}_PACK)));
typedef unsigned long long {0}_bits __attribute__((vector_size(8 * {1}_PACK)));
#else
#define {1}_PACK 1
#define {1}_NOINLINE
#define {1}_INLINE inline
#define {1}_AT(x, i) x[i]
typedef {2} {0}_pack;
#endif
)";

// {0} is the prefix, {1} the prefix in capitals, {2} the scalar.
constexpr const char* kDoubleLanes = R"(/* A number of each of several samples. */
#define {1}_LANES {1}_PACK
typedef {0}_pack {0}_lanes;
)";

constexpr const char* kFloatLanes = R"(/* A number of each of several samples. */
#ifdef {1}_VECTORS
#define {1}_LANES (2 * {1}_PACK)
typedef float {0}_lanes __attribute__((vector_size(4 * {1}_LANES)));
typedef float {0}_half __attribute__((vector_size(4 * {1}_PACK)));
#else
#define {1}_LANES 1
typedef float {0}_lanes;
#endif
)";

constexpr const char* kLoadAndStore = R"(#ifdef {1}_VECTORS
#define {1}_LANE(x, k) x[k]
#else
#define {1}_LANE(x, k) x
#endif

{1}_HELPER {1}_INLINE {0}_lanes {0}_load(const {2} *from) {{
  {0}_lanes x;
  memcpy(&x, from, sizeof x);
  return x;
}}

{1}_HELPER {1}_INLINE void {0}_store({2} *to, {0}_lanes x) {{
  memcpy(to, &x, sizeof x);
}}

/* Rows of the last samples, count of them: as many as there are lanes, copies of the last one, and
 * back. */
{1}_HELPER {1}_NOINLINE void {0}_fill_up(size_t count, size_t n, size_t rows, const {2} *from, {2} *to) {{
  size_t i, k;
  for (i = 0; i < rows; ++i) {{
    for (k = 0; k < {1}_LANES; ++k) to[i * {1}_LANES + k] = from[i * n + (k < count ? k : count - 1)];
  }}
}}

{1}_HELPER {1}_NOINLINE void {0}_take(size_t count, size_t n, size_t rows, const {2} *from, {2} *to) {{
  size_t i, k;
  for (i = 0; i < rows; ++i) {{
    for (k = 0; k < count; ++k) to[i * n + k] = from[i * {1}_LANES + k];
  }}
}}
)";

constexpr const char* kSign = R"(
/* -1, 0 or 1 */
{1}_HELPER {1}_INLINE {0}_lanes {0}_sign_lanes({0}_lanes x) {{
#ifdef {1}_VECTORS
  const {0}_lanes zero = {{0}};
  const {0}_bits one = ({0}_bits)(zero + 1);
  return ({0}_lanes)(one & ({0}_bits)(x > zero)) - ({0}_lanes)(one & ({0}_bits)(x < zero));
#else
  return ({2})((x > 0) - (x < 0));
#endif
}}
)";

/// The smaller or the larger. {3} is its name, {4} the comparison under which it is the first.
constexpr const char* kChoice = R"(
{1}_HELPER {1}_INLINE {0}_lanes {0}_{3}_lanes({0}_lanes x, {0}_lanes y) {{
#ifdef {1}_VECTORS
  const {0}_bits first = ({0}_bits)(x {4} y);
  return ({0}_lanes)((first & ({0}_bits)x) | (~first & ({0}_bits)y));
#else
  return x {4} y ? x : y;
#endif
}}
)";

constexpr const char* kAbsolute = R"(
{1}_HELPER {1}_INLINE {0}_lanes {0}_abs_lanes({0}_lanes x) {{
#ifdef {1}_VECTORS
  const {0}_bits below = ({0}_bits)(x < -x);
  return ({0}_lanes)((below & ({0}_bits)-x) | (~below & ({0}_bits)x));
#else
  return x < -x ? -x : x;
#endif
}}
)";

/// One sample after the other. {3} is the name, {4} the parameters, {5} the call of one sample.
constexpr const char* kEach = R"(
{1}_HELPER {1}_INLINE {0}_lanes {0}_{3}_lanes({4}) {{
  {0}_lanes result = x;
  int k;
  for (k = 0; k < {1}_LANES; ++k) {1}_LANE(result, k) = {5};
  return result;
}}
)";

constexpr const char* kSpread = R"(
{1}_HELPER {1}_INLINE {0}_lanes {0}_spread({2} x) {{
  const {0}_lanes zero = {{0}};
  return zero + x;
}}
)";

}  // namespace

std::string pack_helper(const EmitOptions& options) {
  const std::string upper = upper_case(options.prefix);
  const bool single = options.scalar == Scalar::kFloat;
  std::string text =
      fmt::format(fmt::runtime(kPack), options.prefix, upper, single ? "float" : "double");
  if (single) {
    text += fmt::format(
        "#ifdef {1}_VECTORS\ntypedef double {0}_angle;\n#else\ntypedef float {0}_angle;\n#endif\n",
        options.prefix, upper);
  }
  return text;
}

namespace {

/// A call of one sample after the other.
std::string each_sample(const std::string& call, const EmitOptions& options) {
  const std::string& prefix = options.prefix;
  const std::string upper = upper_case(prefix);
  std::string parameters = prefix + "_lanes x", passed = upper + "_LANE(x, k)";
  if (call == "pow") {
    parameters += ", " + prefix + "_lanes y";
    passed += ", " + upper + "_LANE(y, k)";
  }
  const std::string function =
      is_helper_call(call) ? prefix + "_" + call : c_library_name(call, options.scalar);
  return fmt::format(fmt::runtime(kEach), prefix, upper, "", call, parameters,
                     fmt::format("{}({})", function, passed));
}

}  // namespace

std::string lanes_helper(const EmitOptions& options, const std::set<std::string>& calls) {
  const bool single = options.scalar == Scalar::kFloat;
  const std::string upper = upper_case(options.prefix);
  const auto filled = [&](const std::string& text, const char* name = "", const char* sign = "") {
    return fmt::format(fmt::runtime(text), options.prefix, upper, single ? "float" : "double", name,
                       sign);
  };
  std::string text = filled(std::string(single ? kFloatLanes : kDoubleLanes) + kLoadAndStore);
  for (const std::string& name : calls) {
    if (!name.ends_with("_lanes")) continue;
    const std::string call = name.substr(0, name.size() - std::string("_lanes").size());
    if (call == "sign") {
      text += filled(kSign);
    } else if (call == "min") {
      text += filled(kChoice, "min", "<");
    } else if (call == "max") {
      text += filled(kChoice, "max", ">");
    } else if (call == "abs") {
      text += filled(kAbsolute);
    } else {
      text += each_sample(call, options);
    }
  }
  if (calls.contains("spread")) text += filled(kSpread);
  return text;
}

}  // namespace dyngen
