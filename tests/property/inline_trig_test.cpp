// SPDX-License-Identifier: MIT
// The sines and cosines that stand in the emitted code, against the C library in extended
// precision. bench/bench_trig judges ten million of them by CLN.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "tests/support/inline_trig_library.h"

namespace dyngen::test::inline_trig_tests {
namespace {

constexpr std::uint64_t kSeed = 1995;
constexpr int kPoints = 2'000'000;
constexpr std::size_t kMost = InlineTrigLibrary::kMostAngles;
using Angles = std::array<double, kMost>;

/// Largest error in units in the last place over the angles of one call.
double error_of(const InlineTrigLibrary& library, std::span<const double> x) {
  Angles s{}, c{};
  library(x, std::span(s).first(x.size()), std::span(c).first(x.size()));
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    worst = std::max({worst, units_in_the_last_place(s[i], sinl(x[i])),
                      units_in_the_last_place(c[i], cosl(x[i]))});
  }
  return worst;
}

bool has_judge() { return std::numeric_limits<long double>::digits >= 60; }
constexpr const char* kNoJudge =
    "long double is no wider than double here: there is nothing to compare with";

class InlineTrig : public testing::TestWithParam<std::string> {
 protected:
  InlineTrig() : library_(GetParam()) {}
  InlineTrigLibrary library_;
};

TEST_P(InlineTrig, ErrorIsBelowOneUlp) {
  if (!has_judge()) GTEST_SKIP() << kNoJudge;
  RecordProperty("seed", std::to_string(kSeed));
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double worst = 0;
  for (int i = 0; i < kPoints; i += static_cast<int>(kMost)) {
    Angles x{};
    for (std::size_t k = 0; k < kMost; k += 4) {
      x[k] = 4.0 * unit(random);                                              // where joints are
      x[k + 1] = 3.5e4 * unit(random);                                        // the whole range
      x[k + 2] = std::round(2e4 * unit(random)) * 1.5707963267948966;         // next to zeros
      x[k + 3] = std::ldexp(unit(random), -static_cast<int>(random() % 60));  // small
    }
    worst = std::max(worst, error_of(library_, x));
  }
  EXPECT_LE(worst, 1.0) << "seed " << kSeed;
}

TEST_P(InlineTrig, ErrorIsBelowOneUlpNextToEveryMultipleOfARightAngle) {
  if (!has_judge()) GTEST_SKIP() << kNoJudge;
  double worst = 0;
  for (int k = 1; k * 1.5707963267948966 < 1e5; ++k) {
    const auto at = static_cast<double>(static_cast<long double>(k) * 1.57079632679489661923132L);
    for (const double x : {std::nextafter(at, 0.0), at, -at, std::nextafter(at, 1e6)}) {
      worst = std::max(worst, error_of(library_, std::span(&x, 1)));
    }
  }
  EXPECT_LE(worst, 1.0);
}

double float_error(double value, long double exact) {
  const float size = std::fabs(static_cast<float>(exact));
  const float ulp = std::nextafter(size, std::numeric_limits<float>::infinity()) - size;
  const auto rounded = static_cast<long double>(static_cast<float>(value));
  return static_cast<double>(std::fabs(rounded - exact) / static_cast<long double>(ulp));
}

TEST_P(InlineTrig, SinglePrecisionIsBelowOneUlp) {
  if (!has_judge()) GTEST_SKIP() << kNoJudge;
  const InlineTrigLibrary single(GetParam(), Scalar::kFloat);
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double worst = 0;
  for (int i = 0; i < kPoints; i += 4) {
    const std::array<double, 4> wanted = {
        4.0 * unit(random), 4.9e4 * unit(random),
        std::round(3e4 * unit(random)) * 1.5707963267948966,
        std::ldexp(unit(random), -static_cast<int>(random() % 60))};
    Angles x{}, s{}, c{};
    for (std::size_t k = 0; k < 4; ++k) x[k] = static_cast<double>(static_cast<float>(wanted[k]));
    single(std::span(x).first(4), s, c);
    for (std::size_t k = 0; k < 4; ++k) {
      worst = std::max({worst, float_error(s[k], sinl(x[k])), float_error(c[k], cosl(x[k]))});
    }
  }
  EXPECT_LE(worst, 1.0) << "seed " << kSeed;
  RecordProperty("worst", std::to_string(worst));
}

TEST_P(InlineTrig, AnyNumberOfAnglesGivesTheSame) {
  const Angles x = {0.1, -0.7, 2.5, -3.0, 40.0, 1e-9, 700.0, -1.6};
  Angles one_s{}, one_c{};
  for (std::size_t i = 0; i < kMost; ++i) {
    library_(std::span(x).subspan(i, 1), std::span(one_s).subspan(i, 1),
             std::span(one_c).subspan(i, 1));
  }
  for (std::size_t n = 1; n <= kMost; ++n) {
    Angles s{}, c{};
    library_(std::span(x).first(n), std::span(s).first(n), std::span(c).first(n));
    EXPECT_TRUE(std::equal(s.begin(), s.begin() + static_cast<long>(n), one_s.begin())) << n;
    EXPECT_TRUE(std::equal(c.begin(), c.begin() + static_cast<long>(n), one_c.begin())) << n;
  }
}

TEST_P(InlineTrig, BeyondItsRangeTheLibraryAnswers) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double big : {1.0e5, 1e9, 1e22, -3e300, infinity, std::nan("")}) {
    for (std::size_t n = 1; n <= kMost; ++n) {
      Angles x = {0.5, -0.25, 2.0, 7.0, 0.0, -1.0, 3.0, 0.125}, s{}, c{};
      x[n / 2] = big;
      library_(std::span(x).first(n), std::span(s).first(n), std::span(c).first(n));
      for (std::size_t k = 0; k < n; ++k) {
        EXPECT_EQ(std::isnan(s[k]), std::isnan(std::sin(x[k])));
        if (!std::isnan(s[k])) {
          EXPECT_EQ(s[k], std::sin(x[k])) << x[k];
          EXPECT_EQ(c[k], std::cos(x[k])) << x[k];
        }
      }
    }
  }
}

TEST_P(InlineTrig, ExactValuesAreExact) {
  const Angles x = {0.0, -0.0, 1e-300, -1e-300};
  Angles s{}, c{};
  library_(std::span(x).first(4), s, c);
  for (std::size_t k = 0; k < 4; ++k) {
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
}  // namespace dyngen::test::inline_trig_tests
