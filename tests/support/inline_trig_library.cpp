// SPDX-License-Identifier: MIT
#include "tests/support/inline_trig_library.h"

#include <fmt/format.h>

#include "gen/emit_c/inline_trig.h"
#include "gen/emit_c/lanes.h"

namespace dyngen::test {
namespace {

/// One function that calls those for one to eight angles.
std::string source(Scalar scalar) {
  std::set<std::size_t> sizes;
  std::string cases;
  std::string arguments;
  for (std::size_t n = 1; n <= InlineTrigLibrary::kMostAngles; ++n) {
    sizes.insert(n);
    arguments += fmt::format("x[{}], ", n - 1);
    cases += fmt::format("    case {0}: t_sincos{0}({1}sine, cosine); break;\n", n, arguments);
  }
  EmitOptions options;
  options.prefix = "t";
  options.scalar = scalar;
  return "#include <math.h>\n#define T_HELPER static\n" + pack_helper(options) + sincos_helper(options, sizes, false) +
         "void sincos_of(int n, const double *x, double *s, double *c);\n"
         "void sincos_of(int n, const double *x, double *s, double *c) {\n"
         "  t_pack sine[8], cosine[8];\n  int i;\n  switch (n) {\n" +
         cases +
         "  }\n  for (i = 0; i < n; ++i) {\n"
         "    s[i] = T_AT(sine, i);\n    c[i] = T_AT(cosine, i);\n  }\n}\n";
}

}  // namespace

InlineTrigLibrary::InlineTrigLibrary(const std::string& flags, Scalar scalar)
    : object_({{"trig.c", source(scalar)}}, flags),
      sincos_(reinterpret_cast<decltype(sincos_)>(object_.symbol("sincos_of"))) {}

void InlineTrigLibrary::operator()(std::span<const double> angles, std::span<double> sines,
                                   std::span<double> cosines) const {
  sincos_(static_cast<int>(angles.size()), angles.data(), sines.data(), cosines.data());
}

}  // namespace dyngen::test
