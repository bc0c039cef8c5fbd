// SPDX-License-Identifier: MIT
#include "runtime/logs/log_words.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dyngen::runtime {
namespace {

TEST(LogWords, KindsAreTold) {
  for (const char* word :
       {"1", "-1.5e3", "+2", "1,5", "1.234,5", "0x1F", "true", ".5", "5.", "1d-3", "1'000"}) {
    EXPECT_EQ(kind_of_word(word), WordKind::kNumber) << word;
  }
  for (const char* word :
       {"", "nan", "-nan(ind)", "NaN", "inf", "-INF", "NULL", "#N/A", "1.#IND", "-"}) {
    EXPECT_EQ(kind_of_word(word), WordKind::kMissing) << word;
  }
  for (const char* word :
       {"time", "q1", "1.2.3", "1,2,3", "--1", "1e", "e5", "0x", "12abc", "1 2", "robot 1"}) {
    EXPECT_EQ(kind_of_word(word), WordKind::kText) << word;
  }
}

TEST(LogWords, NumbersNeedTheirDecimalSign) {
  std::string scratch;
  EXPECT_EQ(value_of_word("1.234,5", ',', scratch), 1234.5);
  EXPECT_FALSE(value_of_word("1.234,5", '.', scratch));
  EXPECT_EQ(value_of_word("1,234.5", '.', scratch), 1234.5);
  EXPECT_EQ(value_of_word("-1,5D-3", ',', scratch), -1.5e-3);
  EXPECT_FALSE(value_of_word("1,5", '.', scratch));
  EXPECT_FALSE(value_of_word("12,34.5", '.', scratch));
  EXPECT_EQ(value_of_word("1,234", '.', scratch), 1234);
  EXPECT_EQ(value_of_word("1e-999", '.', scratch), 0);
  EXPECT_TRUE(std::isnan(*value_of_word("1e999", '.', scratch)));
  EXPECT_EQ(value_of_word("0.1", '.', scratch), 0.1);
}

TEST(LogWords, WholeNumbersKeepEveryDigit) {
  EXPECT_TRUE(needs_more_than_double("9007199254740993"));
  EXPECT_FALSE(needs_more_than_double("9007199254740992"));
  EXPECT_TRUE(needs_more_than_double("1423155837.204875"));
  EXPECT_FALSE(needs_more_than_double("1423155837.2"));
  EXPECT_FALSE(needs_more_than_double("0.1234567890123456789"));
  EXPECT_EQ(whole_number("9007199254740993", '.')->count, 9007199254740993);
  EXPECT_EQ(whole_number("1423155837,2048755669", ',')->count, 1423155837204875566);
  EXPECT_FALSE(whole_number("99999999999999999999", '.'));
  EXPECT_FALSE(whole_number("1.5e3", '.'));
}

TEST(LogWords, UnitsStandInBrackets) {
  const auto expect = [](const char* text, const char* name, const char* unit) {
    const NameAndUnit split = split_unit(text);
    EXPECT_EQ(split.name, name) << text;
    EXPECT_EQ(split.unit, unit) << text;
  };
  expect("A1 [°]", "A1", "°");
  expect("q1 (deg)", "q1", "deg");
  expect("Zeit[ms]", "Zeit", "ms");
  expect("tau_1_Nm", "tau_1_Nm", "");
  expect("I1_(A)", "I1", "A");
  expect("speed [furlong]", "speed", "furlong");
  expect("q[1]", "q[1]", "");
  expect("q [1]", "q [1]", "");
  expect("position[shoulder]", "position[shoulder]", "");
  expect("torque (est)", "torque (est)", "");
  expect("[deg]", "[deg]", "");
}

}  // namespace
}  // namespace dyngen::runtime
