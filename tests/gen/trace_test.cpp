// SPDX-License-Identifier: MIT
#include "gen/trace/trace.h"

#include <gtest/gtest.h>

namespace dyngen {
namespace {

class TraceTest : public testing::Test {
 protected:
  TraceTest() {
    x_ = input("x", 0);
    y_ = input("y", 1);
    z_ = input("z", 2);
  }
  GiNaC::ex input(const std::string& name, int index) {
    SymbolInfo info;
    info.name = name;
    info.kind = SymbolKind::kInput;
    info.array = "q";
    info.index = index;
    return inputs_.add(info);
  }

  SymbolTable inputs_;
  GiNaC::ex x_, y_, z_;
  Trace trace_{&inputs_};
};

TEST_F(TraceTest, ZeroOneCopyAndNegationMakeNoStatement) {
  EXPECT_TRUE(trace_.assign("a", 0).is_zero());
  EXPECT_TRUE(trace_.assign("b", x_).is_equal(x_));
  EXPECT_TRUE(trace_.assign("c", -x_).is_equal(-x_));
  EXPECT_TRUE(trace_.assign("d", 1).is_equal(1));
  EXPECT_TRUE(trace_.assign("e", x_ - x_).is_zero());
  EXPECT_TRUE(trace_.assignments().empty());
}

TEST_F(TraceTest, EqualValuesAreOneStatementUpToSign) {
  const GiNaC::ex first = trace_.assign("a", x_ * y_ - z_);
  EXPECT_TRUE(trace_.assign("b", x_ * y_ - z_).is_equal(first));
  EXPECT_TRUE(trace_.assign("c", z_ - y_ * x_).is_equal(-first));
  EXPECT_EQ(trace_.assignments().size(), 1U);
}

TEST_F(TraceTest, NumbersAreWorkedOut) {
  const GiNaC::ex L = trace_.constant("L", GiNaC::numeric(1, 2));
  const GiNaC::ex G = trace_.constant("G", GiNaC::numeric(981, 100));
  const GiNaC::ex product = trace_.assign("LG", L * G);
  EXPECT_EQ(trace_.symbols().info(product).kind, SymbolKind::kConstant);
  EXPECT_TRUE(trace_.symbols().info(product).value.is_equal(GiNaC::numeric(981, 200)));
  trace_.output("tau", 0, trace_.assign("a", L * G * x_));
  EXPECT_EQ(trace_.count().multiplications, 1);
}

TEST_F(TraceTest, RightAngleOffsetsExchangeSinAndCos) {
  const Trace::SinCos plain = trace_.sin_cos("1", x_);
  for (int quarter = -4; quarter <= 4; ++quarter) {
    const Trace::SinCos turned = trace_.sin_cos("1", x_ + quarter * GiNaC::Pi / 2);
    const int turn = (quarter + 8) % 4;
    const GiNaC::ex wanted = turn == 0   ? plain.sin
                             : turn == 1 ? plain.cos
                             : turn == 2 ? GiNaC::ex(-plain.sin)
                                         : GiNaC::ex(-plain.cos);
    EXPECT_TRUE(turned.sin.is_equal(wanted)) << quarter;
  }
  EXPECT_EQ(trace_.assignments().size(), 2U);
  EXPECT_TRUE(trace_.sin_cos("1", -x_).sin.is_equal(-plain.sin));
}

TEST_F(TraceTest, WhatNoOutputNeedsIsDropped) {
  const GiNaC::ex kept = trace_.assign("a", x_ * y_);
  trace_.assign("b", x_ * z_);
  trace_.output("tau", 0, kept);
  trace_.drop_dead_code();
  ASSERT_EQ(trace_.assignments().size(), 1U);
  EXPECT_EQ(trace_.assignments()[0].target.get_name(), "a");
}

TEST_F(TraceTest, WhatWasDroppedIsWrittenAgainWhereItIsNeeded) {
  const Trace::SinCos first = trace_.sin_cos("1", x_);
  const GiNaC::ex product = trace_.assign("P", x_ * y_);
  trace_.output("tau", 0, first.cos);
  trace_.drop_dead_code();
  const Trace::SinCos again = trace_.sin_cos("1", x_);
  EXPECT_TRUE(again.cos.is_equal(first.cos)) << "it is still there";
  EXPECT_FALSE(again.sin.is_equal(first.sin));
  EXPECT_FALSE(trace_.assign("P", x_ * y_).is_equal(product));
  trace_.output("tau", 1, again.sin);
  ASSERT_EQ(trace_.assignments().size(), 3U);
  EXPECT_TRUE(again.sin.is_equal(trace_.assignments()[1].target));
}

TEST_F(TraceTest, OutputThatIsAnInputIsCopiedFirst) {
  trace_.output("tau", 0, -x_);
  ASSERT_EQ(trace_.assignments().size(), 1U);
  EXPECT_EQ(trace_.count().total(), 0);
}

TEST_F(TraceTest, AngleIsAddedOnceAndSinCosCountAsOnePair) {
  const Trace::SinCos both = trace_.sin_cos("1_2", x_ + y_);
  trace_.output("tau", 0, trace_.assign("a", both.sin * both.cos));
  const OperationCount count = trace_.count();
  EXPECT_EQ(count.additions, 1);
  EXPECT_EQ(count.sin_cos_pairs, 1);
}

}  // namespace
}  // namespace dyngen
