// SPDX-License-Identifier: MIT
// The sines and cosines that stand in the emitted code, against the C library in extended
// precision.
#include "gen/emit_c/inline_trig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/shared_object.h"

namespace dyngen::test {
namespace {

constexpr std::uint64_t kSeed = 1995;
constexpr int kPoints = 2'000'000;

using SinCos4 = void (*)(const double*, double*, double*);

class InlineTrig : public testing::TestWithParam<std::string> {
 protected:
  InlineTrig()
      : object_({{"trig.c", "#include <math.h>\n" + sincos_helper("t") +
                                "void sincos4(const double *x, double *s, double *c);\n"
                                "void sincos4(const double *x, double *s, double *c) {\n"
                                "  t_sincos4(x, s, c);\n}\n"}},
                GetParam()),
        sincos4_(reinterpret_cast<SinCos4>(object_.symbol("sincos4"))) {}

  SharedObject object_;
  SinCos4 sincos4_;
};

double units_in_the_last_place(double value, long double exact) {
  const double size = std::fabs(static_cast<double>(exact));
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact)) / ulp;
}

TEST_P(InlineTrig, ErrorIsBelowOneUlp) {
  if (std::numeric_limits<long double>::digits < 60) {
    GTEST_SKIP() << "long double is no wider than double here: there is nothing to compare with";
  }
  RecordProperty("seed", std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double worst = 0;
  for (int i = 0; i < kPoints; i += 4) {
    double x[4], s[4], c[4];
    x[0] = 4.0 * unit(random);                                   // where joints are
    x[1] = 4.9e4 * unit(random);                                 // the whole range
    x[2] = std::round(3e4 * unit(random)) * 1.5707963267948966;  // next to zeros of sin and cos
    x[3] = std::ldexp(unit(random), -static_cast<int>(random() % 60));  // small
    sincos4_(x, s, c);
    for (int k = 0; k < 4; ++k) {
      worst = std::max(worst, units_in_the_last_place(s[k], sinl(x[k])));
      worst = std::max(worst, units_in_the_last_place(c[k], cosl(x[k])));
    }
  }
  EXPECT_LE(worst, 1.0) << "seed " << kSeed;
}

TEST_P(InlineTrig, BeyondItsRangeTheLibraryAnswers) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double big : {1.0e5, 1e9, 1e22, -3e300, infinity, std::nan("")}) {
    const double x[4] = {0.5, big, -0.25, 2.0};
    double s[4], c[4];
    sincos4_(x, s, c);
    for (int k = 0; k < 4; ++k) {
      EXPECT_EQ(std::isnan(s[k]), std::isnan(std::sin(x[k])));
      if (!std::isnan(s[k])) {
        EXPECT_EQ(s[k], std::sin(x[k])) << x[k];
        EXPECT_EQ(c[k], std::cos(x[k])) << x[k];
      }
    }
  }
}

TEST_P(InlineTrig, ExactValuesAreExact) {
  const double x[4] = {0.0, -0.0, 1e-300, -1e-300};
  double s[4], c[4];
  sincos4_(x, s, c);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(s[k], x[k]);
    EXPECT_EQ(c[k], 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Flags, InlineTrig,
                         testing::Values("-std=c99 -O2", "-std=gnu99 -O3 -march=native",
                                         "-std=c99 -O2 -ffast-math"),
                         [](const auto& flags) {
                           std::string name = flags.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); },
                               '_');
                           return name;
                         });

}  // namespace
}  // namespace dyngen::test
