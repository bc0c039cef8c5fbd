// SPDX-License-Identifier: MIT
// The rules of a diagnosis: all in one place, and set by a file.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "runtime/rules/decision_rules.h"
#include "runtime/tools/dynid/options/rules_file.h"
#include "tests/runtime/dynid/run_dynid.h"

namespace dyngen::runtime {
namespace {

namespace fs = std::filesystem;

const std::string kArm = DYNGEN_SOURCE_DIR "/tests/data/cases/gap/arm2.robot";

fs::path written_rules(const std::string& text) {
  const fs::path path =
      fs::path(testing::TempDir()) /
      (std::string(testing::UnitTest::GetInstance()->current_test_info()->name()) + ".rules");
  std::ofstream(path) << text;
  return path;
}

TEST(Rules, AreAllListedOnceAndExplained) {
  const DecisionRules rules;
  std::set<std::string_view> names;
  for (const DecisionRule* rule : all_rules(rules)) {
    EXPECT_TRUE(names.insert(rule->name).second) << rule->name;
    EXPECT_FALSE(rule->unit.empty()) << rule->name;
    EXPECT_FALSE(rule->source.empty()) << rule->name;
    EXPECT_EQ(rule->meaning.back(), '.') << rule->name;
    EXPECT_GT(rule->value, 0) << rule->name;
  }
  EXPECT_EQ(names.size() * sizeof(DecisionRule), sizeof(DecisionRules));
}

TEST(Rules, StandInTheReferenceWithTheirValues) {
  const std::string page = test::content(DYNGEN_SOURCE_DIR "/docs/reference/decision_rules.md");
  const DecisionRules rules;
  for (const DecisionRule* rule : all_rules(rules)) {
    const std::string row = fmt::format("| `{}` | {:g} | {} | {} | {} |", rule->name, rule->value,
                                        rule->unit, rule->meaning, rule->source);
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST(Rules, OfTheCompetitionStandInTheReferenceAsInTheCode) {
  std::istringstream page(test::content(DYNGEN_SOURCE_DIR "/docs/reference/decision_rules.md"));
  const std::regex row(R"(\| `((?:competition|names)/[^`]+)` \| `(k\w+)` \| ([^|]+?) \|)");
  int rows = 0;
  for (std::string line; std::getline(page, line);) {
    std::smatch match;
    if (!std::regex_match(line, match, row)) continue;
    const std::string code =
        std::regex_replace(test::content(DYNGEN_SOURCE_DIR "/runtime/diagnosis/" + match[1].str()),
                           std::regex(R"(\s+)"), " ");
    const std::string constant = fmt::format(" {} = {};", match[2].str(), match[3].str());
    EXPECT_NE(code.find(constant), std::string::npos) << match[1] << ":" << constant;
    ++rows;
  }
  EXPECT_GT(rows, 40);
}

TEST(Rules, ArePrintedAsAFileThatSetsThem) {
  const test::Outcome printed = test::dynid("diagnose --print-rules");
  EXPECT_EQ(printed.exit_code, 0);
  const std::string& text = printed.out;
  DecisionRules changed;
  for (const DecisionRule* rule : all_rules(changed)) {
    ASSERT_NE(text.find(rule->name), std::string::npos) << rule->name;
  }
  EXPECT_TRUE(set_rule(changed, "answer.stability", 0.9));
  EXPECT_FALSE(set_rule(changed, "answer.stabillity", 0.9));
  const DecisionRules read = read_rules(written_rules(rules_text(changed)));
  EXPECT_EQ(read.answer.stability, 0.9);
  const auto a = all_rules(read), b = all_rules(changed);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i]->value, b[i]->value) << a[i]->name;
}

TEST(Rules, OfAFileDecideTheAnswer) {
  const std::string cases = DYNGEN_SOURCE_DIR "/tests/data/cases/";
  const std::string call = "diagnose " + cases + "gap/arm2.robot " + cases + "gap/run.csv.gz";
  const fs::path rules = written_rules("equations.least_equations 1e7  # none has as many\n");
  const test::Outcome outcome = test::dynid(call + " --rules " + rules.string());
  EXPECT_NE(outcome.out.find("too few equations to test what the model leaves"), std::string::npos)
      << outcome.out;
}

TEST(Rules, ThatCannotBeMeantAreRefusedAtTheirPlace) {
  const auto said = [](const std::string& text) {
    return test::dynid("diagnose " + kArm + " none.csv --rules " + written_rules(text).string());
  };
  const auto expect = [&](const std::string& text, const std::string& where,
                          const std::string& what) {
    const test::Outcome outcome = said(text);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
    EXPECT_NE(outcome.out.find(".rules:" + where + ": error: "), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(what), std::string::npos) << outcome.out;
  };
  expect("# studies\n  answer.stabillity 0.9\n", "2:3", "did you mean 'answer.stability'?");
  expect("answer.stability\n", "1:1", "expected one number");
  expect("answer.stability 0.9 1\n", "1:22", "expected one number");
  expect("answer.stability half\n", "1:18", "expected one number");
  expect("answer.stability nan\n", "1:18", "expected one number");
  expect("answer.stability -1\n", "1:18", "not negative");
  expect("answer.stability 0.9\nanswer.stability 0.8\n", "2:1", "stands twice");
  const test::Outcome none = test::dynid("diagnose " + kArm + " none.csv --rules none.rules");
  EXPECT_NE(none.out.find("none.rules: cannot read the rules"), std::string::npos) << none.out;
}

}  // namespace
}  // namespace dyngen::runtime
