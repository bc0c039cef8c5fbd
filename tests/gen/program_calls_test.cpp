// SPDX-License-Identifier: MIT
// Calls as both evaluators of a program compute them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "gen/program/evaluator.h"
#include "gen/program/program.h"
#include "gen/program/scalar_functions.h"
#include "gen/symbols/calls.h"
#include "gen/symbols/exact.h"
#include "gen/trace/assign_calls.h"

namespace dyngen {
namespace {

using GiNaC::ex;

struct Call {
  std::string name;
  int arguments;
  double (*value)(double, double);
};

const std::vector<Call> kCalls = {
    {"sin", 1, [](double x, double) { return std::sin(x); }},
    {"cos", 1, [](double x, double) { return std::cos(x); }},
    {"sign", 1, [](double x, double) { return x > 0   ? 1.0
                                              : x < 0 ? -1.0
                                                      : 0.0; }},
    {"exp", 1, [](double x, double) { return std::exp(x); }},
    {"log", 1, [](double x, double) { return std::log(x); }},
    {"tanh", 1, [](double x, double) { return std::tanh(x); }},
    {"abs", 1, [](double x, double) { return std::abs(x); }},
    {"min", 2, [](double x, double y) { return std::fmin(x, y); }},
    {"max", 2, [](double x, double y) { return std::fmax(x, y); }},
    {"sqrt", 1, [](double x, double) { return std::sqrt(x); }},
    {"pow", 2, [](double x, double y) { return std::pow(x, y); }},
    {"phi", 1, [](double x, double) { return scalar::decay_mean(x); }},
    {"dphi", 1, [](double x, double) { return scalar::decay_mean_slope(x); }},
};

class ProgramCall : public testing::TestWithParam<Call> {};

TEST_P(ProgramCall, IsTheFunctionOfItsName) {
  const Call& call = GetParam();
  SymbolTable inputs;
  std::vector<ex> x;
  for (int i = 0; i < 2; ++i) {
    SymbolInfo info;
    info.name = "x_" + std::to_string(i + 1);
    info.kind = SymbolKind::kInput;
    info.array = "x";
    info.index = i;
    x.push_back(inputs.add(std::move(info)));
  }
  Trace trace(&inputs);
  const std::vector<ex> arguments(x.begin(), x.begin() + call.arguments);
  trace.output("y", 0, assign_calls(trace, "c", make_call(call.name, arguments)));
  trace.output("z", 1, assign_calls(trace, "c", make_call(call.name, arguments) * x[0]));
  const Program program = lower(trace);
  ProgramEvaluator one(program, {"x"}, std::vector<std::string>{"y", "z"});

  const bool positive = call.name == "log" || call.name == "sqrt" || call.name == "pow";
  std::vector<double> first, second;
  for (double a = positive ? 0.125 : -6.0; a <= 6.0; a += 0.21875) {
    first.push_back(a);
    second.push_back(1.3 - a);
  }
  const std::size_t n = first.size();
  std::vector<double> values = first;
  values.insert(values.end(), second.begin(), second.end());
  std::vector<double> y(n), z(2 * n);
  evaluate(program, n, {{"x", values}}, {{"y", y}, {"z", z}});
  for (std::size_t k = 0; k < n; ++k) {
    const double expected = call.value(first[k], second[k]);
    EXPECT_DOUBLE_EQ(y[k], expected) << call.name << " of " << first[k];
    EXPECT_DOUBLE_EQ(z[n + k], expected * first[k]) << call.name << " of " << first[k];
    const double sample[2] = {first[k], second[k]};
    double own_y[1] = {}, own_z[2] = {};
    one.run({sample}, {own_y, own_z});
    EXPECT_EQ(own_y[0], y[k]);
    EXPECT_EQ(own_z[1], z[n + k]);
  }
}

INSTANTIATE_TEST_SUITE_P(calls, ProgramCall, testing::ValuesIn(kCalls),
                         [](const auto& call) { return call.param.name; });

TEST(ScalarFunctions, DecayIsAccurateEverywhere) {
  // against 60 digits: phi and dphi near zero, where the series ends, and far away
  const PrecisionScope precision;
  for (const double size : {0.0, 1e-300, 1e-12, 1e-5, 0.01, 0.3, 0.999, 1.0, 1.001, 3.0, 40.0}) {
    for (const double x : {size, -size}) {
      const double mean = to_double(decay_mean(ex(x)));
      const double slope = to_double(decay_mean_slope(ex(x)));
      EXPECT_NEAR(scalar::decay_mean(x), mean, 1e-15 * std::abs(mean)) << x;
      EXPECT_NEAR(scalar::decay_mean_slope(x), slope, 1e-15 * std::abs(slope)) << x;
    }
  }
}

}  // namespace
}  // namespace dyngen
