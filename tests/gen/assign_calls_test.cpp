// SPDX-License-Identifier: MIT
#include "gen/trace/assign_calls.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gen/symbols/calls.h"
#include "gen/symbols/exact.h"
#include "gen/trace/angles.h"
#include "tests/support/exact_evaluation.h"

namespace dyngen::test {
namespace {

using GiNaC::ex;

class AssignCalls : public testing::Test {
 protected:
  AssignCalls() {
    for (const char* name : {"q_1", "dq_1"}) {
      SymbolInfo info;
      info.name = name;
      info.kind = SymbolKind::kInput;
      info.array = name[0] == 'q' ? "q" : "dq";
      info.index = 0;
      input_.push_back(inputs_.add(std::move(info)));
    }
  }

  std::vector<std::string> statements() const {
    std::vector<std::string> result;
    for (const Assignment& assignment : trace_.assignments()) {
      result.push_back(assignment.target.get_name());
    }
    return result;
  }

  /// What is written has the value of the expression.
  void expect_value(const ex& written, const ex& expression) {
    Trace plain(&inputs_);
    plain.output("y", 0, plain.assign("whole", expression));
    trace_.output("y", 0, written);
    EXPECT_LT(exact_difference(exact_outputs(trace_, 3), exact_outputs(plain, 3)), 1e-40);
  }

  SymbolTable inputs_;
  std::vector<ex> input_;
  Trace trace_{&inputs_};
};

TEST_F(AssignCalls, InnermostComesFirst) {
  const ex expression = input_[0] * GiNaC::exp(-real_abs(input_[1]));
  const ex written = assign_calls(trace_, "e", expression);
  EXPECT_EQ(statements(), (std::vector<std::string>{"e_1", "e_2"}));
  EXPECT_EQ(call_name(trace_.assignments()[0].value), "abs");
  EXPECT_EQ(call_name(trace_.assignments()[1].value), "exp");
  expect_value(written, expression);
}

TEST_F(AssignCalls, EqualCallsAreOneStatement) {
  const ex call = GiNaC::tanh(input_[0] * input_[1]);
  const ex first = assign_calls(trace_, "e", call + input_[0]);
  const ex second = assign_calls(trace_, "f", call * input_[1]);
  EXPECT_EQ(statements(), (std::vector<std::string>{"e_x1", "e_1"}));
  expect_value(first + second, call + input_[0] + call * input_[1]);
}

TEST_F(AssignCalls, NumbersAreWorkedOutNow) {
  const ex Fs = add_constant(inputs_, "Fs", ex(3) / 2), Fc = add_constant(inputs_, "Fc", ex(1) / 3);
  const ex vs = add_constant(inputs_, "vs", ex(1) / 20);
  const ex expression =
      (Fs - Fc) * GiNaC::exp(-GiNaC::pow(input_[1] / vs, 2)) * GiNaC::csgn(input_[1]);
  const ex written = assign_calls(trace_, "e", expression);
  EXPECT_EQ(statements(), (std::vector<std::string>{"me_x1", "e_1"}));
  EXPECT_EQ(trace_.count().divisions, 0);
  const SymbolInfo* inverse = trace_.symbols().find_name("e_K1");
  ASSERT_NE(inverse, nullptr);
  EXPECT_TRUE(inverse->value.is_equal(400) || inverse->value.is_equal(ex(7) / 6)) << inverse->value;
  expect_value(written, expression);
}

TEST_F(AssignCalls, SignOfAnInputStaysWhereItIs) {
  const ex expression = input_[0] * GiNaC::csgn(input_[1]);
  EXPECT_TRUE(assign_calls(trace_, "e", expression).is_equal(expression));
  EXPECT_TRUE(trace_.assignments().empty());
}

TEST_F(AssignCalls, SignOfSomethingElseIsAStatement) {
  const ex expression = GiNaC::csgn(input_[1] - input_[0]);
  expect_value(assign_calls(trace_, "e", expression), expression);
  EXPECT_EQ(trace_.count().signs, 1);
}

TEST_F(AssignCalls, CallsOfNumbersAreNumbers) {
  const ex n = add_constant(inputs_, "n", ex(7) / 2);
  const ex expression = input_[0] * GiNaC::exp(-n) + real_sqrt(2);
  const ex written = assign_calls(trace_, "e", expression);
  EXPECT_TRUE(trace_.assignments().empty());
  expect_value(written, expression);
}

TEST_F(AssignCalls, AnglesOfOneStatementAreKnownBeforeEverythingElse) {
  const ex written =
      assign_calls(trace_, "e", GiNaC::sin(12 * input_[0]) + GiNaC::cos(real_abs(input_[1])));
  trace_.output("y", 0, written);
  const std::vector<ex> angles = find_angles(trace_);
  ASSERT_EQ(angles.size(), 1U);
  EXPECT_EQ(GiNaC::ex_to<GiNaC::symbol>(angles[0]).get_name(), "e_x1");
}

}  // namespace
}  // namespace dyngen::test
