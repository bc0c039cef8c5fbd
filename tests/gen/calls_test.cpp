// SPDX-License-Identifier: MIT
#include "gen/symbols/calls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "gen/diagnostic/assert.h"
#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

using GiNaC::ex;

struct CallCase {
  std::string name;
  std::vector<std::vector<double>> arguments;  ///< where none of the calls has a kink
  std::function<double(const std::vector<double>&)> value;
};

std::vector<CallCase> call_cases() {
  const std::vector<std::vector<double>> any = {{-2.5}, {-0.3}, {0.0}, {1e-9}, {0.7}, {3.1}};
  const std::vector<std::vector<double>> kinked = {{-2.5}, {-0.3}, {0.7}, {3.1}};
  const std::vector<std::vector<double>> positive = {{0.5}, {0.7}, {3.1}};
  const std::vector<std::vector<double>> pairs = {{-2.0, 1.5}, {0.3, -0.2}, {3.0, 4.5}};
  const std::vector<std::vector<double>> powers = {{0.4, 1.7}, {2.0, -0.6}, {3.0, 2.0}};
  const std::vector<std::vector<double>> away = {{-2.5}, {-0.3}, {0.7}, {3.1}, {30.0}};
  return {
      {"sin", any, [](const auto& x) { return std::sin(x[0]); }},
      {"cos", any, [](const auto& x) { return std::cos(x[0]); }},
      {"sign", kinked, [](const auto& x) { return x[0] > 0 ? 1.0 : -1.0; }},
      {"exp", any, [](const auto& x) { return std::exp(x[0]); }},
      {"log", positive, [](const auto& x) { return std::log(x[0]); }},
      {"tanh", any, [](const auto& x) { return std::tanh(x[0]); }},
      {"abs", kinked, [](const auto& x) { return std::abs(x[0]); }},
      {"min", pairs, [](const auto& x) { return std::fmin(x[0], x[1]); }},
      {"max", pairs, [](const auto& x) { return std::fmax(x[0], x[1]); }},
      {"sqrt", positive, [](const auto& x) { return std::sqrt(x[0]); }},
      {"pow", powers, [](const auto& x) { return std::pow(x[0], x[1]); }},
      {"phi", away, [](const auto& x) { return -std::expm1(-x[0]) / x[0]; }},
      {"dphi", away,
       [](const auto& x) { return (std::exp(-x[0]) + std::expm1(-x[0]) / x[0]) / x[0]; }},
  };
}

std::vector<ex> exact(const std::vector<double>& values) {
  std::vector<ex> result;
  for (const double value : values) result.emplace_back(value);
  return result;
}

double value_of(const std::string& name, const std::vector<double>& arguments) {
  return to_double(make_call(name, exact(arguments)));
}

TEST(Calls, HaveTheValuesOfTheMathLibrary) {
  for (const CallCase& call : call_cases()) {
    for (const std::vector<double>& arguments : call.arguments) {
      const double expected = call.value(arguments);
      EXPECT_NEAR(value_of(call.name, arguments), expected, 4e-16 * (1 + std::abs(expected)))
          << call.name << " of " << arguments[0];
    }
  }
}

TEST(Calls, DerivativesAreThoseOfCentralDifferences) {
  constexpr double kStep = 1e-5;
  for (const CallCase& call : call_cases()) {
    for (const std::vector<double>& at : call.arguments) {
      for (std::size_t which = 0; which < at.size(); ++which) {
        std::vector<GiNaC::symbol> symbols;
        std::vector<ex> arguments;
        GiNaC::exmap values;
        for (const double value : at) {
          symbols.emplace_back("x" + std::to_string(symbols.size()));
          arguments.emplace_back(symbols.back());
          values[symbols.back()] = value;
        }
        const ex slope = derivative_of(make_call(call.name, arguments), symbols[which]);
        std::vector<double> before = at, after = at;
        before[which] -= kStep;
        after[which] += kStep;
        const double difference =
            (value_of(call.name, after) - value_of(call.name, before)) / (2 * kStep);
        // differences err by the square of the step and by rounding over the step
        EXPECT_NEAR(to_double(slope.subs(values)), difference, 1e-8 * (1 + std::abs(difference)))
            << call.name << " by its argument " << which << " at " << at[which];
      }
    }
  }
}

TEST(Calls, SecondDerivativeOfADecayIsItsSlopesDerivative) {
  constexpr double kStep = 1e-4;
  const GiNaC::symbol x("x");
  const ex second = derivative_of(decay_mean_slope(x), x);
  for (const double at : {-1.5, 0.4, 6.0}) {
    const double difference =
        (value_of("dphi", {at + kStep}) - value_of("dphi", {at - kStep})) / (2 * kStep);
    EXPECT_NEAR(to_double(second.subs(x == ex(at))), difference, 1e-7);
  }
}

TEST(Calls, DecayKeepsSixtyDigitsNearZero) {
  // phi(x) = 1 - x/2 + x^2/6 - ..., dphi(x) = -1/2 + x/3 - x^2/8 + ...: exact fractions
  const PrecisionScope precision;
  const ex x = ex(1) / GiNaC::pow(ex(10), 20);
  const ex mean = 1 - x / 2 + x * x / 6 - x * x * x / 24;
  const ex slope = -ex(1) / 2 + x / 3 - x * x / 8 + x * x * x / 30;
  const ex tolerance = GiNaC::numeric("1e-58");
  EXPECT_TRUE(GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>((decay_mean(x) - mean).evalf())) <
              GiNaC::ex_to<GiNaC::numeric>(tolerance));
  EXPECT_TRUE(GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>((decay_mean_slope(x) - slope).evalf())) <
              GiNaC::ex_to<GiNaC::numeric>(tolerance));
}

TEST(Calls, DecayIsSmoothWhereItsSeriesEnds) {
  const PrecisionScope precision;
  const GiNaC::numeric step("1e-40");
  for (const char* name : {"phi", "dphi"}) {
    for (const int side : {-1, 1}) {
      const ex inside = make_call(name, {side * (1 - step)}).evalf();
      const ex outside = make_call(name, {side * (1 + step)}).evalf();
      EXPECT_TRUE(GiNaC::abs(GiNaC::ex_to<GiNaC::numeric>(inside - outside)) <
                  GiNaC::numeric("1e-39"))
          << name;
    }
  }
}

TEST(Calls, ExactArgumentsGiveExactNumbers) {
  EXPECT_TRUE(real_abs(-ex(3) / 7).is_equal(ex(3) / 7));
  EXPECT_TRUE(real_sqrt(ex(9) / 16).is_equal(ex(3) / 4));
  EXPECT_TRUE(real_min(2, -5).is_equal(-5));
  EXPECT_TRUE(real_max(2, -5).is_equal(2));
  EXPECT_TRUE(real_pow(ex(2) / 3, 3).is_equal(ex(8) / 27));
  EXPECT_TRUE(decay_mean(0).is_equal(1));
  EXPECT_TRUE(decay_mean_slope(0).is_equal(-ex(1) / 2));
  const GiNaC::symbol x("x");
  EXPECT_TRUE(real_pow(x, 0).is_equal(1));
  EXPECT_TRUE(real_pow(x, 1).is_equal(x));
  EXPECT_TRUE(real_min(x, x).is_equal(x));
}

TEST(Calls, NumbersWithoutAFractionKeepTheirCall) {
  EXPECT_DOUBLE_EQ(to_double(real_sqrt(2)), std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(to_double(real_min(GiNaC::Pi, 3)), 3.0);
  EXPECT_DOUBLE_EQ(to_double(real_abs(-GiNaC::Pi)), std::acos(-1.0));
}

TEST(Calls, NamesGoThereAndBack) {
  const GiNaC::symbol x("x"), y("y");
  for (const CallCase& call : call_cases()) {
    const bool two = call.arguments.front().size() == 2;
    EXPECT_EQ(call_name(make_call(call.name, two ? std::vector<ex>{x, y} : std::vector<ex>{x})),
              call.name);
  }
  EXPECT_EQ(call_name(x), "");
  EXPECT_EQ(call_name(GiNaC::sinh(x)), "");
}

TEST(Calls, WrongNamesAndArgumentsAreBugs) {
  EXPECT_THROW(make_call("sinh", {1}), InternalError);
  EXPECT_THROW(make_call("min", {1}), InternalError);
}

TEST(Calls, SignHasNoDerivative) {
  const GiNaC::symbol x("x");
  EXPECT_TRUE(derivative_of(x * GiNaC::csgn(x), x).is_equal(GiNaC::csgn(x)));
}

}  // namespace
}  // namespace dyngen
