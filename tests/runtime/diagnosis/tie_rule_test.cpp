// SPDX-License-Identifier: MIT
#include "runtime/diagnosis/competition/tie_rule.h"

#include <gtest/gtest.h>

namespace dyngen::runtime {
namespace {

TEST(TieRule, PutsFewerParametersFirstWhereChiSquareIsEqualButForRounding) {
  const Standing many{100.2, 3}, few{100.2 - 1e-9, 2};
  EXPECT_TRUE(comes_before(few, many));
  EXPECT_FALSE(comes_before(many, few));
}

TEST(TieRule, LetsMoreChiSquareWinAgainstFewerParameters) {
  const Standing more{101, 9}, few{100.2, 1};
  EXPECT_TRUE(comes_before(more, few));
  EXPECT_FALSE(comes_before(few, more));
}

TEST(TieRule, LeavesEqualEffectsInTheOrderOfTheCatalogue) {
  const Standing first{100.2, 2}, second{100.2 + 1e-9, 2};
  EXPECT_FALSE(comes_before(first, second));
  EXPECT_FALSE(comes_before(second, first));
}

}  // namespace
}  // namespace dyngen::runtime
