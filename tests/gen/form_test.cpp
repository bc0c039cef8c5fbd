// SPDX-License-Identifier: MIT
#include "gen/trace/form.h"

#include <gtest/gtest.h>

#include "gen/symbols/exact.h"

namespace dyngen {
namespace {

class FormTest : public testing::Test {
 protected:
  FormTest() {
    for (const char* name : {"a", "b", "c", "d"}) {
      SymbolInfo info;
      info.name = name;
      symbols_.push_back(table_.add(info));
    }
  }
  GiNaC::ex s(int i) const { return symbols_[static_cast<std::size_t>(i)]; }

  std::string text(const GiNaC::ex& value) const { return spell(canonical_form(value, table_)); }
  std::string spell(const Form& form) const {
    if (form.kind == Form::Kind::kNumber) return shortest_decimal(form.leaf);
    if (form.kind == Form::Kind::kSymbol) return table_.info(form.leaf).name;
    if (form.kind == Form::Kind::kCall) return form.call + "(" + spell(form.parts[0]) + ")";
    return join_operands(form, [this](const Form& part) { return spell(part); });
  }
  OperationCount count(const GiNaC::ex& value) const {
    return count_operations(canonical_form(value, table_));
  }

  SymbolTable table_;
  std::vector<GiNaC::symbol> symbols_;
};

TEST_F(FormTest, OperandsStandInTheOrderOfTheTable) {
  EXPECT_EQ(text(s(2) * s(0) + s(1)), "b + a * c");
  EXPECT_EQ(text(s(3) * s(1) * s(2)), "b * c * d");
}

TEST_F(FormTest, PositiveTermLeadsSoThatNoMinusCosts) {
  EXPECT_EQ(text(s(2) - s(0)), "c - a");
  EXPECT_EQ(text(-s(0) - s(1)), "-a - b");
}

TEST_F(FormTest, TermThatIsReadyLastStandsLast) {
  EXPECT_EQ(text(s(0) * s(3) + s(1) * s(2)), "b * c + a * d");
}

TEST_F(FormTest, SquareIsAProduct) {
  EXPECT_EQ(text(s(0) * s(0)), "a * a");
  EXPECT_EQ(count(s(0) * s(0)).multiplications, 1);
}

TEST_F(FormTest, SignHasAnArgumentThatBeginsPositive) {
  EXPECT_EQ(text(GiNaC::csgn(s(1) - s(0))), "-sign(a - b)");
  EXPECT_EQ(text(s(2) * GiNaC::csgn(-s(0) * (s(1) - s(2)))), "-sign(a * (b - c)) * c");
}

TEST_F(FormTest, InnerSumKeepsItsBrackets) { EXPECT_EQ(text(s(0) * (s(1) - s(2))), "a * (b - c)"); }

TEST_F(FormTest, NumbersCountAsFactorsButSignsDoNot) {
  EXPECT_EQ(text(2 * s(0) - s(1)), "2.0 * a - b");
  EXPECT_EQ(count(2 * s(0) - s(1)).multiplications, 1);
  EXPECT_EQ(count(2 * s(0) - s(1)).additions, 1);
  EXPECT_EQ(count(-s(0)).total(), 0);
}

TEST_F(FormTest, DivisionIsCountedApart) {
  EXPECT_EQ(text(1 / s(0)), "1.0 / a");
  EXPECT_EQ(text(s(1) / s(0) - s(2)), "b / a - c");
  EXPECT_EQ(text(s(2) * s(1) / (s(0) * s(3))), "b * c / (a * d)");
  EXPECT_EQ(text(-s(1) / (s(0) - s(2))), "-b / (a - c)");
  EXPECT_EQ(count(s(1) / s(0)).divisions, 1);
  EXPECT_EQ(count(s(1) / s(0)).total(), 0);
}

TEST_F(FormTest, SignIsCountedApart) {
  const OperationCount counted = count(s(0) * GiNaC::csgn(s(1)));
  EXPECT_EQ(counted.signs, 1);
  EXPECT_EQ(counted.total(), 1);
}

TEST(Exact, NumbersAreTheShortestThatReadBack) {
  EXPECT_EQ(shortest_decimal(GiNaC::numeric(981, 100)), "9.81");
  EXPECT_EQ(shortest_decimal(GiNaC::numeric(1, 10)), "0.1");
  EXPECT_EQ(shortest_decimal(GiNaC::ex(2)), "2.0");
  EXPECT_EQ(shortest_decimal(GiNaC::pow(GiNaC::numeric(10), 300)), "1e+300");
  EXPECT_EQ(shortest_decimal_float(GiNaC::numeric(1, 10)), "0.1");
  EXPECT_EQ(std::stod(shortest_decimal(GiNaC::Pi)), 3.141592653589793);
}

TEST(Exact, ZeroIsSeenThroughTwoRoads) {
  const GiNaC::ex same = GiNaC::sqrt(GiNaC::ex(2)) / 2 - GiNaC::sin(GiNaC::Pi / 4);
  EXPECT_TRUE(is_zero_number(same));
  EXPECT_TRUE(is_zero_number(exact_sin(GiNaC::numeric(3, 10)) * exact_sin(GiNaC::numeric(3, 10)) +
                             exact_cos(GiNaC::numeric(3, 10)) * exact_cos(GiNaC::numeric(3, 10)) -
                             1));
  EXPECT_FALSE(is_zero_number(GiNaC::numeric(1) / GiNaC::pow(GiNaC::numeric(10), 60)));
}

TEST(Exact, RoundingIsDroppedFromSums) {
  const GiNaC::symbol x("x"), y("y");
  const GiNaC::ex s = exact_sin(1), c = exact_cos(1);
  EXPECT_TRUE(drop_rounding((s * s + c * c) * x - x + y).is_equal(y));
}

}  // namespace
}  // namespace dyngen
