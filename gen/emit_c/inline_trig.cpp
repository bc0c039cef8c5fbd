// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/inline_trig.h"

#include <fmt/format.h>

#include <algorithm>

#include "gen/emit_c/c_spelling.h"
#include "gen/emit_c/lanes.h"

namespace dyngen {
namespace {

constexpr std::size_t kMostAngles = 8;  // of one call: all in registers

// Statements of the kernels; every value is one of registers a and b, which "@" stands for, so that
// neither register waits for the other. The tail t of the reduced angle r + t keeps the last bit
// right near multiples of pi/2.
constexpr std::string_view kReduction =
    R"(D sum@ = x@ * 0.6366197723675814 + whole;
D k@ = sum@ - whole; /* right angles in x */
D r0@ = x@ - k@ * 1.5707963267341256; /* exact */
D p@ = k@ * 6.077100506303966e-11; /* exact */
D r@ = r0@ - p@;
D z@ = r@ * r@;
D w@ = z@ * z@;
D s3@ = z@ * 1.58969099521155010221e-10 - 2.50507602534068634195e-08;
D s2@ = z@ * 2.75573137070700676789e-06 - 1.98412698298579493134e-04;
D c3@ = 2.08757232129817482790e-09 - z@ * 1.13596475577881948265e-11;
D c2@ = 2.48015872894767294178e-05 - z@ * 2.75573143513906633035e-07;
D s1@ = z@ * 8.33333333332248946124e-03 - 1.66666666666666324348e-01;
D c1@ = 4.16666666666666019037e-02 - z@ * 1.38888888888741095749e-03;
D t@ = ((r0@ - r@) - p@) - k@ * 2.0222662487959506e-21; /* x - k pi/2 = r + t */
D h@ = 0.5 * z@;
D u@ = 1.0 - h@;
D sp@ = s1@ + w@ * (s2@ + w@ * s3@);
D cp@ = c1@ + w@ * (c2@ + w@ * c3@);
D s@ = r@ + (t@ * u@ + z@ * r@ * sp@);
D c@ = u@ + (((1.0 - u@) - h@) - r@ * t@ + w@ * cp@);
)";

// For float: double arithmetic leaves all bits of a float right.
constexpr std::string_view kFloatReduction =
    R"(D sum@ = x@ * 0.6366197723675814 + whole;
D k@ = sum@ - whole; /* right angles in x */
D r@ = (x@ - k@ * 1.5707963267341256) - k@ * 6.077100506506192e-11;
D z@ = r@ * r@;
D w@ = z@ * z@;
D s1@ = z@ * 0.0083333293858894632 - 0.16666666641626524;
D s2@ = z@ * 0.0000027183114939898219 - 0.00019839334836096632;
D c1@ = 1.0 - z@ * 0.499999997251031003120;
D c2@ = 0.0416666233237390631894 - z@ * 0.00138867637746099294692;
D s@ = r@ + z@ * r@ * (s1@ + w@ * s2@);
D c@ = c1@ + w@ * (c2@ + w@ * 0.0000243904487962774090654);
)";

// The last bits of sum are those of k: the quadrant.
constexpr std::string_view kQuadrant =
    R"(B i@ = (BITS)sum@;
B swap@ = ((BITS)s@ ^ (BITS)c@) & -(i@ & 1);
)";

constexpr std::string_view kResult =
    R"(sine[#] = (LANES)((BITS)s@ ^ swap@ ^ ((i@ & 2) << 62));
cosine[#] = (LANES)((BITS)c@ ^ swap@ ^ (((i@ + 1) & 2) << 62));
)";

std::string replaced(std::string text, std::string_view what, const std::string& by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at)) {
    text.replace(at, what.size(), by);
    at += by.size();
  }
  return text;
}

/// The statements for one register or two, each for all registers before the next.
std::string kernel_statements(std::string_view statements, int registers,
                              const std::string& prefix) {
  std::string text;
  while (!statements.empty()) {
    const std::size_t end = statements.find('\n');
    std::string line(statements.substr(0, end));
    statements.remove_prefix(end + 1);
    for (int i = 0; i < registers; ++i) {
      if (i == 1) line = line.substr(0, line.find(" /*"));
      std::string one = line;
      if (one.starts_with("D ")) one = "const " + prefix + "_pack" + one.substr(1);
      if (one.starts_with("B ")) one = "const " + prefix + "_bits" + one.substr(1);
      one = replaced(one, "BITS", prefix + "_bits");
      one = replaced(one, "LANES", prefix + "_pack");
      one = replaced(one, "@", registers == 1 ? "" : i == 0 ? "a" : "b");
      text += "  " + replaced(one, "#", std::to_string(i)) + "\n";
    }
  }
  return text;
}

// {0} is the signature, {1} the statements.
constexpr std::string_view kKernel =
    R"({0}
#ifdef __clang__
#pragma clang fp reassociate(off)
#endif
  const double whole = 6755399441055744.0; /* 1.5 * 2^52: adding it rounds to an integer */
{1}}}
)";

constexpr const char* kComment =
    R"(/* Sines and cosines of a register of angles, or of two at once, without a branch: within 1 ulp for
 * |x| < 1e5, rounding to nearest.  Reduction by pi/2 in three parts (Cody and Waite 1980),
 * coefficients of fdlibm (Sun Microsystems 1993).  -ffast-math would undo the reduction: the C
 * library is called then. */
)";

constexpr const char* kFloatComment =
    R"(/* Sines and cosines of a register of angles, or of two at once, without a branch, for single
 * precision: to 1e-8 for |x| < 1e5, rounding to nearest.  Reduction by pi/2 in two parts (Cody and
 * Waite 1980), coefficients of FreeBSD's k_sinf.c and k_cosf.c.  -ffast-math would undo the
 * reduction: the C library is called then. */
)";

std::string kernels(const std::string& prefix, bool single) {
  const std::string upper = upper_case(prefix);
  std::string text = single ? kFloatComment : kComment;
  text += fmt::format(
      "#if defined({0}_VECTORS) && !defined(__FAST_MATH__) && !defined(__ASSOCIATIVE_MATH__)\n"
      "#define {0}_INLINE_TRIG\n",
      upper);
  for (int registers = 1; registers <= 2; ++registers) {
    std::string load =
        registers == 1 ? "D x = angle[0];\n" : "D xa = angle[0];\nD xb = angle[1];\n";
    std::string statements = kernel_statements(load, 1, prefix);
    for (const std::string_view part :
         {single ? kFloatReduction : kReduction, kQuadrant, kResult}) {
      statements += kernel_statements(part, registers, prefix);
    }
    if (registers == 2) text += "\n";
    const std::string signature = wrap_arguments(fmt::format(
        "{1}_HELPER {1}_INLINE void {0}_sincos_kernel{2}(const {0}_pack *angle, {0}_pack *sine, "
        "{0}_pack *cosine) {{",
        prefix, upper, registers));
    text += fmt::format(kKernel, signature, statements);
  }
  return text + "#endif\n";
}

/// "{x0, x1}, {x2, 0.0}": the angles in groups, filled up with zeros.
std::string groups(std::size_t count, std::size_t lanes) {
  std::string text;
  for (std::size_t i = 0; i < count; i += lanes) {
    text += i > 0 ? ", {" : "{";
    for (std::size_t l = i; l < i + lanes; ++l) {
      text += (l > i ? ", " : "") + (l < count ? fmt::format("x{}", l) : std::string("0.0"));
    }
    text += "}";
  }
  return text;
}

/// The calls of the kernels for one width of registers.
std::string kernel_calls(const std::string& prefix, std::size_t count, std::size_t lanes) {
  const std::size_t registers = (count + lanes - 1) / lanes;
  std::string text = wrap_list(fmt::format("    const {}_pack v[{}] = {{", prefix, registers),
                               groups(count, lanes) + "};");
  for (std::size_t v = 0; v < registers; v += 2) {
    const std::string offset = v == 0 ? "" : fmt::format(" + {}", v);
    text += fmt::format("    {0}_sincos_kernel{1}(v{2}, s{2}, c{2});\n", prefix,
                        v + 1 < registers ? 2 : 1, offset);
  }
  return text;
}

// {0} is the prefix, {1} the prefix in capitals, {2} the scalar, {3} "f" for float, {4} what
// computes the sines of one register.
constexpr const char* kLanes =
    R"(/* Sines and cosines of n angles of each sample. */
{1}_HELPER {1}_NOINLINE void {0}_sincos_lanes(int n, const {0}_lanes *x, {0}_lanes *s, {0}_lanes *c) {{
  int i, k;
#ifdef {1}_INLINE_TRIG
  {0}_lanes size = {{0}};
  {2} total = 0.0{3};
  for (i = 0; i < n; ++i) size += x[i] * x[i];
{4}
  for (k = 0; k < {1}_LANES; ++k) total += {1}_LANE(size, k);
  if (total < 1e10{3}) return;
#endif
  for (k = 0; k < {1}_LANES; ++k) {{
#ifdef {1}_INLINE_TRIG
    if ({1}_LANE(size, k) < 1e10{3}) continue;
#endif
    for (i = 0; i < n; ++i) {{
      {1}_LANE(s[i], k) = sin{3}({1}_LANE(x[i], k));
      {1}_LANE(c[i], k) = cos{3}({1}_LANE(x[i], k));
    }}
  }}
}}
)";

constexpr const char* kLoop =
    R"(  for (i = 0; i + 1 < n; i += 2) {0}_sincos_kernel2(x + i, s + i, c + i);
  if (i < n) {0}_sincos_kernel1(x + i, s + i, c + i);)";

/// A register of floats is two of doubles.
constexpr const char* kFloatLoop = R"(  for (i = 0; i < n; ++i) {{
    {0}_half half[2];
    {0}_pack angle[2], sine[2], cosine[2];
    memcpy(half, x + i, sizeof half);
    angle[0] = __builtin_convertvector(half[0], {0}_pack);
    angle[1] = __builtin_convertvector(half[1], {0}_pack);
    {0}_sincos_kernel2(angle, sine, cosine);
    half[0] = __builtin_convertvector(sine[0], {0}_half);
    half[1] = __builtin_convertvector(sine[1], {0}_half);
    memcpy(s + i, half, sizeof half);
    half[0] = __builtin_convertvector(cosine[0], {0}_half);
    half[1] = __builtin_convertvector(cosine[1], {0}_half);
    memcpy(c + i, half, sizeof half);
  }})";

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
std::string sincos_function(const EmitOptions& options, std::size_t count) {
  const bool single = options.scalar == Scalar::kFloat;
  const std::string& prefix = options.prefix;
  const std::string type = single ? prefix + "_angle" : "double";
  const std::string upper = upper_case(prefix);
  std::string parameters, values;
  for (std::size_t i = 0; i < count; ++i) {
    parameters += fmt::format("{} x{}, ", type, i);
    values += (i > 0 ? ", " : "") + fmt::format("x{}", i);
  }
  std::string text = wrap_arguments(
      fmt::format("{0}_HELPER {0}_NOINLINE void {1}_sincos{2}({3}{1}_pack *s, {1}_pack *c) {{\n",
                  upper, prefix, count, parameters));
  text += fmt::format("  const {} x[{}] = {{{}}};\n  int i;\n", type, count, values);
  text += fmt::format("#ifdef {}_INLINE_TRIG\n  if ({} < 1e10) {{\n", upper, squares(0, count));
  text += fmt::format("#if {}_PACK == 8\n{}", upper, kernel_calls(prefix, count, 8));
  text += fmt::format("#elif {}_PACK == 4\n{}", upper, kernel_calls(prefix, count, 4));
  text +=
      fmt::format("#else\n{}#endif\n    return;\n  }}\n#endif\n", kernel_calls(prefix, count, 2));
  const auto call = [&](const char* function) {
    return single ? fmt::format("({})", type) + function + "f((float)x[i])"
                  : function + std::string("(x[i])");
  };
  return text + fmt::format(
                    "  for (i = 0; i < {0}; ++i) {{\n    {1}_AT(s, i) = {2};\n"
                    "    {1}_AT(c, i) = {3};\n  }}\n}}\n",
                    count, upper, call("sin"), call("cos"));
}

}  // namespace

std::optional<SineOf> find_sine(const GiNaC::ex& value, const std::vector<GiNaC::ex>& angles) {
  if (!is_sin_or_cos(value)) return {};
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (!angles[i].is_equal(value.op(0))) continue;
    return SineOf{i, GiNaC::ex_to<GiNaC::function>(value).get_name() == "cos"};
  }
  return {};
}

std::vector<std::size_t> sincos_sizes(std::size_t angles) {
  std::vector<std::size_t> sizes(angles / kMostAngles, kMostAngles);
  if (angles % kMostAngles != 0) sizes.push_back(angles % kMostAngles);
  return sizes;
}

std::string sincos_calls(const std::vector<std::string>& angles, const EmitOptions& options) {
  const std::string& prefix = options.prefix;
  const std::string cast = options.scalar == Scalar::kFloat ? "(" + prefix + "_angle)" : "";
  std::string declarations, calls;
  std::size_t first = 0;
  int call = 1;
  for (const std::size_t size : sincos_sizes(angles.size())) {
    declarations +=
        fmt::format("  {0}_pack sine{1}[{2}], cosine{1}[{2}];\n", prefix, call,
                    fmt::format("({0} + {1}_PACK - 1) / {1}_PACK", size, upper_case(prefix)));
    std::string list;
    for (std::size_t i = first; i < first + size; ++i) list += cast + angles[i] + ", ";
    calls += wrap_arguments(
        fmt::format("  {0}_sincos{1}({2}sine{3}, cosine{3});\n", prefix, size, list, call));
    first += size;
    ++call;
  }
  return declarations + calls;
}

std::string sine_in_register(const SineOf& sine, const EmitOptions& options) {
  return fmt::format("{}{}_AT({}{}, {})", options.scalar == Scalar::kFloat ? "(float)" : "",
                     upper_case(options.prefix), sine.cosine ? "cosine" : "sine",
                     sine.angle / kMostAngles + 1, sine.angle % kMostAngles);
}

std::string sincos_lanes_calls(const std::vector<std::string>& angles, const EmitOptions& options) {
  std::string list, calls;
  for (const std::string& angle : angles) list += (list.empty() ? "" : ", ") + angle;
  std::size_t first = 0;
  for (const std::size_t size : sincos_sizes(angles.size())) {  // the same calls as for one sample
    const std::string offset = first == 0 ? "" : fmt::format(" + {}", first);
    calls += fmt::format("  {0}_sincos_lanes({1}, angle{2}, sine{2}, cosine{2});\n", options.prefix,
                         size, offset);
    first += size;
  }
  return wrap_list(fmt::format("  const {}_lanes angle[{}] = {{", options.prefix, angles.size()),
                   list + "};") +
         fmt::format("  {0}_lanes sine[{1}], cosine[{1}];\n{2}", options.prefix, angles.size(),
                     calls);
}

std::string sine_in_lanes(const SineOf& sine) {
  return fmt::format("{}[{}]", sine.cosine ? "cosine" : "sine", sine.angle);
}

std::string sincos_helper(const EmitOptions& options, const std::set<std::size_t>& sizes,
                          bool lanes) {
  const bool single = options.scalar == Scalar::kFloat;
  const std::string& prefix = options.prefix;
  const std::string upper = upper_case(prefix);
  std::string text;
  if (options.trig == Trig::kInline) {
    text += kernels(prefix, single);
    for (const std::size_t size : sizes) text += "\n" + sincos_function(options, size);
  }
  if (!lanes) return text;
  const std::string kernel = fmt::format(fmt::runtime(single ? kFloatLoop : kLoop), prefix);
  if (!text.empty()) text += "\n";
  return text + fmt::format(fmt::runtime(kLanes), prefix, upper, single ? "float" : "double",
                            single ? "f" : "", kernel);
}

}  // namespace dyngen
