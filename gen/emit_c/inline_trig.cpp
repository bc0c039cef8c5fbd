// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/inline_trig.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/emit_c/c_spelling.h"
#include "gen/emit_c/lanes.h"

namespace dyngen {
namespace {

constexpr std::size_t kMostAngles = 8;  // of one call: all in registers

bool is_sin_or_cos(const GiNaC::ex& value) {
  if (!GiNaC::is_a<GiNaC::function>(value)) return false;
  const std::string name = GiNaC::ex_to<GiNaC::function>(value).get_name();
  return name == "sin" || name == "cos";
}

// {0} is the prefix, {1} the prefix in capitals. The tail t of the reduced angle r + t keeps the
// last bit right near multiples of pi/2.
constexpr const char* kKernel =
    R"(/* Sines and cosines of a register of angles, without a branch: within 1 ulp for |x| < 1e5, rounding
 * to nearest.  Reduction by pi/2 in three parts (Cody and Waite 1980), coefficients of fdlibm (Sun
 * Microsystems 1993).  -ffast-math would undo the reduction: the C library is called then. */
#if defined({1}_VECTORS) && !defined(__FAST_MATH__) && !defined(__ASSOCIATIVE_MATH__)
#define {1}_INLINE_TRIG
static {1}_INLINE void {0}_sincos_kernel(const {0}_doubles *angle, {0}_doubles *sine,
    {0}_doubles *cosine) {{
#ifdef __clang__
#pragma clang fp reassociate(off)
#endif
  const double whole = 6755399441055744.0; /* 1.5 * 2^52: adding it rounds to an integer */
  const {0}_doubles x = *angle;
  const {0}_doubles sum = x * 0.6366197723675814 + whole;
  const {0}_doubles k = sum - whole;                 /* right angles in x */
  const {0}_doubles r0 = x - k * 1.5707963267341256; /* exact */
  const {0}_doubles p = k * 6.077100506303966e-11;   /* exact */
  const {0}_doubles r = r0 - p;
  const {0}_doubles t = ((r0 - r) - p) - k * 2.0222662487959506e-21; /* x - k pi/2 = r + t */
  const {0}_doubles z = r * r;
  const {0}_doubles w = z * z;
  const {0}_doubles h = 0.5 * z;
  const {0}_doubles u = 1.0 - h;
  const {0}_doubles s1 = z * 8.33333333332248946124e-03 - 1.66666666666666324348e-01;
  const {0}_doubles s2 = z * 2.75573137070700676789e-06 - 1.98412698298579493134e-04;
  const {0}_doubles s3 = z * 1.58969099521155010221e-10 - 2.50507602534068634195e-08;
  const {0}_doubles s = r + (t * u + z * r * (s1 + w * (s2 + w * s3)));
  const {0}_doubles c1 = 4.16666666666666019037e-02 - z * 1.38888888888741095749e-03;
  const {0}_doubles c2 = 2.48015872894767294178e-05 - z * 2.75573143513906633035e-07;
  const {0}_doubles c3 = 2.08757232129817482790e-09 - z * 1.13596475577881948265e-11;
  const {0}_doubles c = u + (((1.0 - u) - h) - r * t + w * (c1 + w * (c2 + w * c3)));
  const {0}_bits i = ({0}_bits)sum; /* its last bits are those of k */
  const {0}_bits swap = (({0}_bits)s ^ ({0}_bits)c) & -(i & 1);
  *sine = ({0}_doubles)(({0}_bits)s ^ swap ^ ((i & 2) << 62));
  *cosine = ({0}_doubles)(({0}_bits)c ^ swap ^ (((i + 1) & 2) << 62));
}}
#endif
)";

/// "{x0, x1}, {x2, 0.0}": the angles in groups, filled up with zeros.
std::vector<std::string> groups(std::size_t count, std::size_t lanes) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < count; i += lanes) {
    std::string group;
    for (std::size_t l = i; l < i + lanes; ++l) {
      group += (l > i ? ", " : "") + (l < count ? fmt::format("x{}", l) : std::string("0.0"));
    }
    result.push_back(group);
  }
  return result;
}

/// The calls of the kernel for one width of registers.
std::string kernel_calls(const std::string& prefix, std::size_t count, std::size_t lanes) {
  std::string declarations, calls;
  const std::vector<std::string> registers = groups(count, lanes);
  for (std::size_t v = 0; v < registers.size(); ++v) {
    declarations += fmt::format("    const {}_doubles v{} = {{{}}};\n", prefix, v, registers[v]);
    const std::string offset = v == 0 ? "" : fmt::format(" + {}", v);
    calls += fmt::format("    {0}_sincos_kernel(&v{1}, s{2}, c{2});\n", prefix, v, offset);
  }
  return declarations + calls;
}

/// "x0 * x0 + x1 * x1", split in halves so that the terms do not wait for each other.
std::string squares(std::size_t first, std::size_t count) {
  if (count == 1) return fmt::format("x{0} * x{0}", first);
  const std::size_t half = (count + 1) / 2;
  const std::string left = squares(first, half), right = squares(first + half, count - half);
  return (half > 1 ? "(" + left + ")" : left) + " + " +
         (count - half > 1 ? "(" + right + ")" : right);
}

/// The function for so many angles: arguments in registers, no array that a wider load must wait
/// for.
std::string sincos_function(const std::string& prefix, std::size_t count) {
  const std::string upper = upper_case(prefix);
  std::string parameters, values;
  for (std::size_t i = 0; i < count; ++i) {
    parameters += fmt::format("double x{}, ", i);
    values += (i > 0 ? ", " : "") + fmt::format("x{}", i);
  }
  std::string text = wrap_arguments(
      fmt::format("static {0}_NOINLINE void {1}_sincos{2}({3}{1}_doubles *s, {1}_doubles *c) {{\n",
                  upper, prefix, count, parameters));
  text += fmt::format("  const double x[{}] = {{{}}};\n  int i;\n", count, values);
  text += fmt::format("#ifdef {}_INLINE_TRIG\n  if ({} < 1e10) {{\n", upper, squares(0, count));
  text += fmt::format("#if {}_DOUBLES == 8\n{}", upper, kernel_calls(prefix, count, 8));
  text += fmt::format("#elif {}_DOUBLES == 4\n{}", upper, kernel_calls(prefix, count, 4));
  text +=
      fmt::format("#else\n{}#endif\n    return;\n  }}\n#endif\n", kernel_calls(prefix, count, 2));
  return text + fmt::format(
                    "  for (i = 0; i < {0}; ++i) {{\n    {1}_AT(s, i) = sin(x[i]);\n"
                    "    {1}_AT(c, i) = cos(x[i]);\n  }}\n}}\n",
                    count, upper);
}

}  // namespace

std::vector<GiNaC::ex> find_angles(const Trace& trace) {
  std::vector<GiNaC::ex> angles;
  for (const Assignment& assignment : trace.assignments()) {
    if (!is_sin_or_cos(assignment.value)) continue;
    const GiNaC::ex angle = assignment.value.op(0);
    if (!is_one_of(angles, angle)) angles.push_back(angle);
  }
  return angles;
}

bool is_one_of(const std::vector<GiNaC::ex>& angles, const GiNaC::ex& symbol) {
  return std::any_of(angles.begin(), angles.end(),
                     [&](const GiNaC::ex& angle) { return angle.is_equal(symbol); });
}

std::string gathered_value(const GiNaC::ex& value, const std::vector<GiNaC::ex>& angles,
                           const std::string& prefix) {
  if (!is_sin_or_cos(value)) return {};
  const std::string name = GiNaC::ex_to<GiNaC::function>(value).get_name();
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (angles[i].is_equal(value.op(0))) {
      const std::string array =
          fmt::format("{}{}", name == "sin" ? "sine" : "cosine", i / kMostAngles + 1);
      return fmt::format("{}_AT({}, {})", upper_case(prefix), array, i % kMostAngles);
    }
  }
  return {};
}

std::vector<std::size_t> sincos_sizes(std::size_t angles) {
  std::vector<std::size_t> sizes(angles / kMostAngles, kMostAngles);
  if (angles % kMostAngles != 0) sizes.push_back(angles % kMostAngles);
  return sizes;
}

std::string sincos_calls(const std::vector<std::string>& angles, const std::string& prefix) {
  std::string declarations, calls;
  std::size_t first = 0;
  int call = 1;
  for (const std::size_t size : sincos_sizes(angles.size())) {
    declarations +=
        fmt::format("  {0}_doubles sine{1}[{2}], cosine{1}[{2}];\n", prefix, call,
                    fmt::format("({0} + {1}_DOUBLES - 1) / {1}_DOUBLES", size, upper_case(prefix)));
    std::string list;
    for (std::size_t i = first; i < first + size; ++i) list += angles[i] + ", ";
    calls += wrap_arguments(
        fmt::format("  {0}_sincos{1}({2}sine{3}, cosine{3});\n", prefix, size, list, call));
    first += size;
    ++call;
  }
  return declarations + calls;
}

std::string sincos_helper(const std::string& prefix, const std::set<std::size_t>& sizes) {
  std::string text = fmt::format(fmt::runtime(kKernel), prefix, upper_case(prefix));
  for (const std::size_t size : sizes) text += "\n" + sincos_function(prefix, size);
  return text;
}

}  // namespace dyngen
