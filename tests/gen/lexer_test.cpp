// SPDX-License-Identifier: MIT
#include "gen/robot_file/lexer.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace dyngen {
namespace {

std::vector<std::string> texts(const std::vector<Word>& words) {
  std::vector<std::string> result;
  for (const Word& word : words) result.emplace_back(word.text);
  return result;
}

using Strings = std::vector<std::string>;

TEST(SplitWords, SeparatesAtBlanksCommasAndComments) {
  EXPECT_EQ(texts(split_words("d 0,1\t2 , pi/2 # 3 4\n; 5\nr 6;7")),
            (Strings{"d", "0", "1", "2", "pi/2", "r", "6"}));
  EXPECT_TRUE(split_words("").empty());
  EXPECT_TRUE(split_words(" \t\r\n # only\n").empty());
}

TEST(SplitWords, CountsLinesAndColumnsFromOne) {
  const std::vector<Word> words = split_words("ab c\r\n\n  de # x\nf");
  ASSERT_EQ(words.size(), 4U);
  EXPECT_EQ(words[0].position.line, 1);
  EXPECT_EQ(words[0].position.column, 1);
  EXPECT_EQ(words[1].position.column, 4);
  EXPECT_EQ(words[2].position.line, 3);
  EXPECT_EQ(words[2].position.column, 3);
  EXPECT_EQ(words[2].length, 2);
  EXPECT_EQ(words[3].position.line, 4);
}

TEST(SplitWords, CountsColumnsInCharactersNotBytes) {
  const std::vector<Word> words = split_words("\xc3\xa9\xc3\xa9 x");
  ASSERT_EQ(words.size(), 2U);
  EXPECT_EQ(words[0].length, 2);
  EXPECT_EQ(words[1].position.column, 4);
}

TEST(SplitWords, KnowsWhatBeginsALineAndFollowsAComma) {
  const std::vector<Word> words = split_words("d 1,2\n  3");
  ASSERT_EQ(words.size(), 4U);
  EXPECT_TRUE(words[0].begins_line);
  EXPECT_FALSE(words[1].begins_line);
  EXPECT_FALSE(words[1].after_comma);
  EXPECT_TRUE(words[2].after_comma);
  EXPECT_TRUE(words[3].begins_line);
}

TEST(SplitWords, MakesABadWordOfACommaThatSeparatesNothing) {
  EXPECT_EQ(texts(split_words("d 1,,2")), (Strings{"d", "1", ",", "2"}));
  EXPECT_EQ(texts(split_words("d 1,\n,2")), (Strings{"d", "1", ",", "2"}));
  EXPECT_TRUE(split_words(",")[0].is_bad());
}

TEST(SplitWords, FindsTheFirstBadCharacter) {
  EXPECT_FALSE(split_words("number'link")[0].is_bad());
  EXPECT_FALSE(split_words("vs=-(.5+L_1)^2/3*4")[0].is_bad());
  EXPECT_EQ(split_words("ab$c%")[0].bad, 2U);
  EXPECT_EQ(split_words("1\xff")[0].bad, 1U);
}

TEST(SplitWords, PassesOverAByteOrderMarkAtTheStartOnly) {
  EXPECT_FALSE(split_words("\xef\xbb\xbfsigma 0")[0].is_bad());
  EXPECT_TRUE(split_words("a \xef\xbb\xbfsigma")[1].is_bad());
}

TEST(SplitWords, LeavesCommentsUnread) { EXPECT_TRUE(split_words("# \xff\x01 $").empty()); }

std::vector<std::string> tokens(std::string_view value) {
  std::vector<std::string> result;
  for (const Token& token : split_tokens(value)) {
    const char kind = token.kind == TokenKind::kNumber      ? 'n'
                      : token.kind == TokenKind::kMalformed ? '!'
                      : token.kind == TokenKind::kName      ? 'a'
                      : token.kind == TokenKind::kSymbol    ? 's'
                                                            : 'e';
    result.push_back(kind + std::string(token.text));
  }
  return result;
}

TEST(SplitTokens, ReadsEveryFormOfNumber) {
  for (const std::string number :
       {"0", "12", ".5", "5.", "1.25", "1e3", "1E-3", "1.e+03", ".5e0"}) {
    EXPECT_EQ(tokens(number), (Strings{"n" + number, "e"}));
  }
}

TEST(SplitTokens, MarksMalformedNumbers) {
  for (const std::string number : {".", "1.2.3", "1..", "1e", "1e+", "1e5.5", "1e-."}) {
    EXPECT_EQ(tokens(number).front(), "!" + number);
  }
}

TEST(SplitTokens, SeparatesNamesNumbersAndOperators) {
  EXPECT_EQ(tokens("-2*L_1^(pi+.5)"),
            (Strings{"s-", "n2", "s*", "aL_1", "s^", "s(", "api", "s+", "n.5", "s)", "e"}));
  EXPECT_EQ(tokens("90deg"), (Strings{"n90", "adeg", "e"}));
  EXPECT_EQ(tokens("2e_max"), (Strings{"n2", "ae_max", "e"}));
}

}  // namespace
}  // namespace dyngen
