// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/emit_c/inline_trig.h"

#include <fmt/format.h>

#include <algorithm>

namespace dyngen {
namespace {

constexpr std::size_t kLanes = 4;

bool is_sin_or_cos(const GiNaC::ex& value) {
  if (!GiNaC::is_a<GiNaC::function>(value)) return false;
  const std::string name = GiNaC::ex_to<GiNaC::function>(value).get_name();
  return name == "sin" || name == "cos";
}

// {0} is the prefix. The tail t of the reduced angle r + t keeps the last bit right near multiples
// of pi/2.
constexpr const char* kHelper =
    R"(/* Sines and cosines of four angles at once, without a branch that depends on them: compilers
 * vectorise it.  Within 1 ulp for |x| < 1e5, rounding to nearest; beyond, for what is not finite, on
 * other processors and under -ffast-math the C library is called.  Reduction by pi/2 in three parts
 * (Cody and Waite 1980), coefficients of fdlibm (Sun Microsystems 1993). */
static void {0}_sincos4(const double x[4], double sine[4], double cosine[4]) {{
  int i;
#if (defined(__x86_64__) || defined(__aarch64__)) && !defined(__FAST_MATH__) && \
    !defined(__ASSOCIATIVE_MATH__)
  double s[4], c[4], size = 0.0;
  for (i = 0; i < 4; ++i) size += x[i] * x[i];
  if (size < 1e10) {{
#ifdef __clang__
#pragma clang fp reassociate(off)
#endif
    const double whole = 6755399441055744.0; /* 1.5 * 2^52: adding it rounds to an integer */
    for (i = 0; i < 4; ++i) {{
      const double k = (x[i] * 0.6366197723675814 + whole) - whole; /* right angles in x */
      const double r0 = x[i] - k * 1.5707963267341256;              /* exact */
      const double p = k * 6.077100506303966e-11;                   /* exact */
      const double r1 = r0 - p;
      const double p1 = k * 2.0222662487959506e-21 - ((r0 - r1) - p);
      const double r = r1 - p1;         /* x - k pi/2 = r + t */
      const double t = (r1 - r) - p1;
      const double z = r * r;
      const double w = z * z;
      const double ps = (8.33333333332248946124e-03 - z * 1.98412698298579493134e-04) +
                        w * (2.75573137070700676789e-06 +
                             z * (z * 1.58969099521155010221e-10 - 2.50507602534068634195e-08));
      const double sr =
          r + (z * (r * (z * ps - 1.66666666666666324348e-01) - 0.5 * t) + t);
      const double pc = z * (4.16666666666666019037e-02 - z * 1.38888888888741095749e-03) +
                        z * w * (2.48015872894767294178e-05 +
                                 z * (z * (2.08757232129817482790e-09 -
                                           z * 1.13596475577881948265e-11) -
                                      2.75573143513906633035e-07));
      const double h = 0.5 * z;
      const double u = 1.0 - h;
      const double cr = u + (((1.0 - u) - h) + (z * pc - r * t));
      const double m = k - 4.0 * ((k * 0.25 + whole) - whole); /* quadrant, -2 .. 2 */
      const double cm = 1.0 - fabs(m);                         /* its cosine */
      const double sm = m * (2.0 - fabs(m));                   /* its sine */
      s[i] = cm * sr + sm * cr;
      c[i] = cm * cr - sm * sr;
    }}
    for (i = 0; i < 4; ++i) {{
      sine[i] = s[i];
      cosine[i] = c[i];
    }}
    return;
  }}
#endif
  for (i = 0; i < 4; ++i) {{
    sine[i] = sin(x[i]);
    cosine[i] = cos(x[i]);
  }}
}}
)";

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

std::string gathered_value(const GiNaC::ex& value, const std::vector<GiNaC::ex>& angles) {
  if (!is_sin_or_cos(value)) return {};
  const std::string name = GiNaC::ex_to<GiNaC::function>(value).get_name();
  for (std::size_t i = 0; i < angles.size(); ++i) {
    if (angles[i].is_equal(value.op(0))) {
      return fmt::format("{}[{}]", name == "sin" ? "sine" : "cosine", i);
    }
  }
  return {};
}

std::string sincos_call(const std::vector<std::string>& angles, const std::string& prefix) {
  const std::size_t size = (angles.size() + kLanes - 1) / kLanes * kLanes;
  std::string list;
  for (std::size_t i = 0; i < size; ++i) {
    list += (i > 0 ? ", " : "") + (i < angles.size() ? angles[i] : std::string("0.0"));
  }
  std::string text = fmt::format(
      "  const double angle[{0}] = {{{1}}};\n  double sine[{0}], cosine[{0}];\n", size, list);
  for (std::size_t i = 0; i < size; i += kLanes) {
    text += i == 0
                ? fmt::format("  {}_sincos4(angle, sine, cosine);\n", prefix)
                : fmt::format("  {0}_sincos4(angle + {1}, sine + {1}, cosine + {1});\n", prefix, i);
  }
  return text;
}

std::string sincos_helper(const std::string& prefix) {
  return fmt::format(fmt::runtime(kHelper), prefix);
}

}  // namespace dyngen
