// SPDX-License-Identifier: MIT
#include "gen/diagnostic/diagnostic.h"

#include <gtest/gtest.h>

#include <string>

#include "gen/diagnostic/utf8.h"

namespace dyngen {
namespace {

TEST(Diagnostics, ShowPlaceLineCaretAndHint) {
  Diagnostics diagnostics("robots/arm2.robot", "sigma 0 0\nd 0 L3\n");
  diagnostics.error({2, 5}, 2, "unknown symbol 'L3' in 'd'", "declared: L1, L2");
  EXPECT_EQ(diagnostics.render(),
            "robots/arm2.robot:2:5: error: unknown symbol 'L3' in 'd'\n"
            "    2 | d 0 L3\n"
            "      |     ^~ declared: L1, L2\n");
}

TEST(Diagnostics, StandInTheOrderOfTheText) {
  Diagnostics diagnostics("f", "one\ntwo\n");
  diagnostics.warning({2, 2}, 1, "c");
  diagnostics.error({2, 1}, 1, "b");
  diagnostics.error({1, 3}, 1, "a");
  EXPECT_EQ(diagnostics.render(),
            "f:1:3: error: a\n    1 | one\n      |   ^\n"
            "f:2:1: error: b\n    2 | two\n      | ^\n"
            "f:2:2: warning: c\n    2 | two\n      |  ^\n");
}

TEST(Diagnostics, WithoutLineNameTheFileOnly) {
  Diagnostics diagnostics("arm.robot", "");
  diagnostics.error({}, 1, "cannot read: No such file or directory");
  EXPECT_EQ(diagnostics.render(), "arm.robot: error: cannot read: No such file or directory\n");
}

TEST(Diagnostics, MayPointBehindTheEndOfALine) {
  Diagnostics diagnostics("f", "d 0");
  diagnostics.error({1, 4}, 5, "short");
  EXPECT_EQ(diagnostics.render(), "f:1:4: error: short\n    1 | d 0\n      |    ^\n");
}

TEST(Diagnostics, KeepTabsAlignedByRepeatingThem) {
  Diagnostics diagnostics("f", "d\t0\tx");
  diagnostics.error({1, 5}, 1, "m");
  EXPECT_EQ(diagnostics.render(), "f:1:5: error: m\n    1 | d\t0\tx\n      |  \t \t^\n");
}

TEST(Diagnostics, ShowUnprintableCharactersAsQuestionMarks) {
  // Escape (a terminal would obey), a byte that is not UTF-8, a right-to-left override; then é,
  // which is shown.
  Diagnostics diagnostics("f", "a\x1b\xff\xe2\x80\xae\xc3\xa9z\r\n");
  diagnostics.error({1, 6}, 1, "m");
  EXPECT_EQ(diagnostics.render(), "f:1:6: error: m\n    1 | a???\xc3\xa9z\n      |      ^\n");
}

TEST(Diagnostics, KeepAMessageInItsLine) {
  Diagnostics diagnostics("f", "x");
  diagnostics.error({1, 1}, 1, std::string("not '\0\n\xff'", 9), "write \t1");
  EXPECT_EQ(diagnostics.render(), "f:1:1: error: not '??\?'\n    1 | x\n      | ^ write ?1\n");
}

TEST(Diagnostics, ClipALongLineAroundTheCaret) {
  const std::string line = std::string(500000, 'a') + "X" + std::string(500000, 'b');
  Diagnostics diagnostics("f", line);
  diagnostics.error({1, 500001}, 1, "m");
  EXPECT_EQ(diagnostics.render(), "f:1:500001: error: m\n    1 | ..." + std::string(60, 'a') + "X" +
                                      std::string(39, 'b') + "...\n      |    " +
                                      std::string(60, ' ') + "^\n");
}

TEST(Diagnostics, KeepTwentyErrorsAndCountTheRest) {
  Diagnostics diagnostics("f", "x");
  for (int i = 0; i < 19; ++i) diagnostics.error({1, 1}, 1, "m");
  EXPECT_FALSE(diagnostics.full());
  for (int i = 0; i < 3; ++i) diagnostics.error({1, 1}, 1, "m");
  EXPECT_TRUE(diagnostics.full());
  EXPECT_EQ(diagnostics.all().size(), 20U);
  EXPECT_TRUE(diagnostics.render().ends_with("f: 2 more errors left out\n"));
}

TEST(Diagnostics, WarningsAreNoErrors) {
  Diagnostics diagnostics("f", "x");
  diagnostics.warning({1, 1}, 1, "m");
  EXPECT_FALSE(diagnostics.has_errors());
}

TEST(Printable, CutsALongPieceAndCleansIt) {
  EXPECT_EQ(printable("a\nb"), "a?b");
  EXPECT_EQ(printable(std::string(100, 'x')), std::string(60, 'x') + "...");
}

TEST(Utf8, RejectsOverlongSurrogateAndTooLargeCodes) {
  for (const std::string text : {"\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                                 "\x80", "\xe2\x82", "\xff", "\xc3("}) {
    EXPECT_FALSE(decode_utf8(text, 0).valid) << printable(text);
    EXPECT_EQ(decode_utf8(text, 0).size, 1U);
  }
}

TEST(Utf8, DecodesOneToFourBytes) {
  const std::string text = "a\xc3\xa9\xe2\x88\x92\xf0\x9f\xa4\x96";
  EXPECT_EQ(decode_utf8(text, 0).code, U'a');
  EXPECT_EQ(decode_utf8(text, 1).code, U'\u00e9');
  EXPECT_EQ(decode_utf8(text, 3).code, U'\u2212');
  EXPECT_EQ(decode_utf8(text, 6).code, U'\U0001f916');
  EXPECT_EQ(character_count(text), 4);
}

}  // namespace
}  // namespace dyngen
