// SPDX-License-Identifier: MIT
#include "gen/robot_file/expression.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace dyngen {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::Pi;

class ExpressionTest : public testing::Test {
 protected:
  /// The value of a word; its messages go to messages_.
  Evaluation evaluated(const std::string& text) {
    const std::vector<Word> words = split_words(text);
    Diagnostics diagnostics("f", text);
    Evaluation result = evaluate(words.front(), "d", names_, diagnostics);
    messages_ = diagnostics.render();
    EXPECT_EQ(result.number.has_value(), messages_.empty()) << text;
    return result;
  }

  ex exact(const std::string& text) {
    const Evaluation result = evaluated(text);
    EXPECT_TRUE(result.number) << messages_;
    return result.number ? result.number->exact() : ex(-12345);
  }

  double number(const std::string& text) {
    return GiNaC::ex_to<numeric>(exact(text).evalf()).to_double();
  }

  void expect_error(const std::string& text, int column, const std::string& message) {
    EXPECT_FALSE(evaluated(text).number) << text;
    const std::string expected = "f:1:" + std::to_string(column) + ": error: " + message + "\n";
    EXPECT_EQ(messages_.substr(0, messages_.find('\n') + 1), expected) << text;
  }

  LetNames names_;
  std::string messages_;
};

TEST_F(ExpressionTest, DecimalsAreExactRationals) {
  EXPECT_TRUE(exact("0.1").is_equal(numeric(1, 10)));
  EXPECT_TRUE(exact("0.1+0.2-0.3").is_zero());
  EXPECT_TRUE(exact(".5").is_equal(numeric(1, 2)));
  EXPECT_TRUE(exact("5.").is_equal(5));
  EXPECT_TRUE(exact("1.25e-2").is_equal(numeric(1, 80)));
  EXPECT_TRUE(exact("1E3").is_equal(1000));
  EXPECT_TRUE(exact("000.500e+01").is_equal(5));
  EXPECT_TRUE(exact("1/3*3").is_equal(1));
}

TEST_F(ExpressionTest, PiAndDegreesAreExact) {
  EXPECT_TRUE(exact("pi/2").is_equal(Pi / 2));
  EXPECT_TRUE(exact("90*deg").is_equal(Pi / 2));
  EXPECT_TRUE(exact("cos(90*deg)").is_zero());
  EXPECT_TRUE(exact("sin(pi/6)").is_equal(numeric(1, 2)));
  EXPECT_TRUE(exact("sqrt(2)^2").is_equal(2));
  EXPECT_TRUE(exact("cos(pi/4)-sqrt(2)/2").is_zero());
}

TEST_F(ExpressionTest, PrecedenceIsTheUsualOne) {
  EXPECT_TRUE(exact("1+2*3").is_equal(7));
  EXPECT_TRUE(exact("(1+2)*3").is_equal(9));
  EXPECT_TRUE(exact("10-4-3").is_equal(3));
  EXPECT_TRUE(exact("24/4/3").is_equal(2));
  EXPECT_TRUE(exact("-2^2").is_equal(-4));
  EXPECT_TRUE(exact("(-2)^2").is_equal(4));
  EXPECT_TRUE(exact("2^3^2").is_equal(512));
  EXPECT_TRUE(exact("2^-1").is_equal(numeric(1, 2)));
  EXPECT_TRUE(exact("2*-3").is_equal(-6));
  EXPECT_TRUE(exact("--2+-+3").is_equal(-1));
}

TEST_F(ExpressionTest, RootsOfSquaresAreRational) {
  EXPECT_TRUE(exact("sqrt(4/9)").is_equal(numeric(2, 3)));
  EXPECT_TRUE(exact("8^(1/3)").is_equal(2));
}

TEST_F(ExpressionTest, LetNamesStandForTheirExactValues) {
  names_.declare("L", {1, 5}, *evaluated("0.1").number);
  EXPECT_TRUE(exact("L*10").is_equal(1));
  expect_error("l*10", 1, "unknown symbol 'l' in 'd'");
}

TEST_F(ExpressionTest, AWrongLetRowIsNotReportedAgain) {
  names_.declare("L", {1, 5}, std::nullopt);
  Diagnostics diagnostics("f", "L+1");
  const std::vector<Word> words = split_words("L+1");
  EXPECT_FALSE(evaluate(words.front(), "d", names_, diagnostics).number);
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST_F(ExpressionTest, WhatCancelsBeyondGiNaCsSightIsExactlyZero) {
  EXPECT_TRUE(exact("sin(1)^2+cos(1)^2-1").is_zero());
  EXPECT_TRUE(exact("sqrt(3+2*sqrt(2))-1-sqrt(2)").is_zero());
  EXPECT_FALSE(exact("sin(1)^2+cos(1)^2-1+1e-30").is_zero());
  EXPECT_FALSE(exact("1e-60*pi").is_zero());
  EXPECT_FALSE(exact("pi-3.14159265358979323846264338").is_zero());
  expect_error("1/(sin(1)^2+cos(1)^2-1)", 2, "division by zero in 'd'");
}

TEST_F(ExpressionTest, ArithmeticWithoutARealResultIsAnError) {
  expect_error("1/0", 2, "division by zero in 'd'");
  expect_error("1/(pi-pi)", 2, "division by zero in 'd'");
  expect_error("0^-1", 2, "division by zero in 'd'");
  expect_error("0^0", 2, "0^0 is not defined in 'd'");
  expect_error("sqrt(1-2)", 1, "square root of a negative number in 'd'");
  expect_error("(3-pi)^.5", 7, "a negative number has no real power with a broken exponent in 'd'");
}

TEST_F(ExpressionTest, ValuesBeyondDoubleAreErrors) {
  expect_error("1e999", 1, "the number is outside the range of double in 'd'");
  expect_error("1e99999999999999999999", 1, "the number is outside the range of double in 'd'");
  expect_error("1e309", 1, "the value in 'd' is outside the range of double");
  expect_error("1e-320", 1, "the value in 'd' is outside the range of double");
  EXPECT_DOUBLE_EQ(number("1.7976931348623157e308"), std::numeric_limits<double>::max());
  EXPECT_TRUE(exact("1e309/1e308").is_equal(10)) << "only the value itself must fit";
}

TEST_F(ExpressionTest, HugePowersAreRefusedBeforeTheyAreWorkedOut) {
  expect_error("9^9^9", 2, "the exponent is too large in 'd'");
  expect_error("(1/3)^1000^-1^1000*2^(2^9)^3", 21, "the exponent is too large in 'd'");
  expect_error("1.0000001^999", 10, "the result has too many digits in 'd'");
  expect_error("(1e300*pi)^99", 11, "the result has too many digits in 'd'");
  expect_error("sin(1e99)", 1, "the angle is too large in 'd'");
}

TEST_F(ExpressionTest, DeepNestingIsAnErrorAndNoCrash) {
  EXPECT_TRUE(exact(std::string(150, '(') + "1" + std::string(150, ')')).is_equal(1));
  for (const char* opening : {"(", "-", "2^", "sin("}) {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += opening;
    EXPECT_FALSE(evaluated(text).number);
    EXPECT_NE(messages_.find("nested too deeply"), std::string::npos) << opening;
  }
}

TEST_F(ExpressionTest, LongSumsAreRead) {
  std::string text = "0";
  for (int i = 0; i < 20000; ++i) text += "+1";
  EXPECT_TRUE(exact(text).is_equal(20000));
}

TEST_F(ExpressionTest, SyntaxErrorsPointAtTheirCharacter) {
  expect_error("1+", 2, "expected a value after '+' in 'd'");
  expect_error("*2", 1, "expected a value before '*' in 'd'");
  expect_error("2*/3", 3, "expected a value instead of '/' in 'd'");
  expect_error("(1+2", 1, "'(' without ')' in 'd'");
  expect_error("1+2)", 4, "')' without '(' in 'd'");
  expect_error("90deg", 3, "expected an operator between '90' and 'deg' in 'd'");
  expect_error("1.2.3", 1, "'1.2.3' is not a number");
  expect_error("2+tan(1)", 3, "unknown function 'tan' in 'd'");
  expect_error("nan", 1, "'nan' in 'd' is not a finite number");
}

/// A random expression and its value in double arithmetic.
struct Sample {
  std::string text;
  double value;
};

Sample sample(std::mt19937& random, int depth) {
  const auto pick = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  if (depth == 0 || pick(4) == 0) {
    if (pick(4) == 0) return {"pi", std::numbers::pi};
    const int digits = 1 + pick(99);
    return {std::to_string(digits / 10) + "." + std::to_string(digits % 10), digits / 10.0};
  }
  const Sample a = sample(random, depth - 1);
  const Sample b = sample(random, depth - 1);
  const std::string both[] = {"(" + a.text + "+" + b.text + ")", "(" + a.text + "-" + b.text + ")",
                              a.text + "*" + b.text + "/10"};
  switch (pick(6)) {
    case 0:
      return {both[0], a.value + b.value};
    case 1:
      return {both[1], a.value - b.value};
    case 2:
      return {both[2], a.value * b.value / 10};
    case 3:
      return {"sin(" + a.text + ")", std::sin(a.value)};
    case 4:
      return {"sqrt((" + a.text + ")^2+1)", std::sqrt(a.value * a.value + 1)};
    default:
      return {"cos(" + a.text + ")/(2+sin(" + b.text + "))",
              std::cos(a.value) / (2 + std::sin(b.value))};
  }
}

// Values stay below 20 or so, so rounding grows by that factor a level: 20^4 times 1e-16, and
// rarely so.
TEST_F(ExpressionTest, AgreesWithDoubleArithmetic) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const Sample expected = sample(random, 4);
    EXPECT_NEAR(number(expected.text), expected.value,
                1e-10 * std::max(1.0, std::fabs(expected.value)))
        << expected.text;
  }
}

}  // namespace
}  // namespace dyngen
