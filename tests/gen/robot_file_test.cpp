// SPDX-License-Identifier: MIT
#include "gen/robot_file/robot_file.h"
#include "gen/robot_input/robot_input.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "gen/robot_input/robot_input.h"

namespace dyngen {
namespace {

using GiNaC::numeric;
using GiNaC::Pi;

RobotFile parse(const std::string& text) { return parse_robot_file(text, "arm.robot"); }

std::string errors_of(const std::string& text) {
  try {
    parse(text);
    return "";
  } catch (const ModelError& error) {
    return error.what();
  }
}

RobotFile read_golden(const std::string& name) {
  return read_robot_file(std::string(DYNGEN_SOURCE_DIR "/tests/golden/") + name);
}

/// Whether a row holds these numbers; "*" stands for unknown.
testing::AssertionResult holds(const RobotFile& file, RowKey key,
                               const std::vector<GiNaC::ex>& expected) {
  const Row& row = file.row(key);
  if (!row.present || row.values.size() != expected.size()) {
    return testing::AssertionFailure() << row_keyword(key) << " has " << row.values.size();
  }
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (row.values[i].unknown || !row.values[i].value.is_equal(expected[i])) {
      return testing::AssertionFailure()
             << row_keyword(key) << " value " << i + 1 << " is " << row.values[i].text;
    }
  }
  return testing::AssertionSuccess();
}

TEST(RobotFile, ReadsTheDocumentedExample) {
  const RobotFile file = read_golden("design_example.robot");
  EXPECT_EQ(file.name, "puma560_arm");
  EXPECT_EQ(file.joint_count, 3);
  EXPECT_EQ(file.convention, DhConvention::kModified);
  EXPECT_TRUE(holds(file, RowKey::kSigma, {0, 0, 0}));
  EXPECT_TRUE(holds(file, RowKey::kAl, {0, Pi / 2, 0}));
  EXPECT_TRUE(holds(file, RowKey::kD, {0, 0, numeric(4318, 10000)}));
  EXPECT_TRUE(holds(file, RowKey::kAnt, {0, 1, 2}));
  EXPECT_TRUE(holds(file, RowKey::kQmin, {-Pi * 8 / 9, -Pi * 5 / 4, -Pi / 4}));
  EXPECT_TRUE(holds(file, RowKey::kGz, {numeric(981, 100)}));
  EXPECT_TRUE(file.row(RowKey::kM).values[2].unknown);
  EXPECT_TRUE(
      file.row(RowKey::kMX).values[1].value.is_equal(numeric(1184, 1000) - numeric(8, 10000)));
  EXPECT_EQ(file.row(RowKey::kMX).values[1].text, "17.4*0.068");
  EXPECT_EQ(file.row(RowKey::kD).values[2].text, "L");
  EXPECT_EQ(file.joint_names, (std::vector<std::string>{"shoulder", "upper", "elbow"}));
  ASSERT_EQ(file.effects.size(), 2U);
  EXPECT_EQ(file.effects[0].name, "stribeck");
  ASSERT_EQ(file.effects[0].settings.size(), 3U);
  EXPECT_EQ(file.effects[0].settings[2].key, "vs");
  EXPECT_TRUE(file.effects[0].settings[2].value.value.is_equal(numeric(1, 20)));
  EXPECT_TRUE(file.effects[1].settings[1].value.unknown);
  EXPECT_TRUE(file.warnings.empty());
}

TEST(RobotFile, BaseParametersMayHaveAnySign) {
  const std::string rows = "number_link 2\nm 1 -2\nIA 0 -0.1\nFs -1 0\ngz 9.81\n";
  EXPECT_NE(errors_of(rows + "stop\n").find("negative value -0.1 in 'IA'"), std::string::npos);
  EXPECT_NE(errors_of(rows + "parameters bodies\nstop\n"), "");
  const RobotFile file = parse(rows + "Parameters BASE\nstop\n");
  EXPECT_EQ(file.parameters, ParameterMeaning::kBase);
  ASSERT_EQ(file.warnings.size(), 1U);  // friction is no sum
  EXPECT_EQ(file.warnings[0].position.line, 4);
  EXPECT_EQ(parse("number_link 1\ngz 9.81\nstop\n").parameters, ParameterMeaning::kBodies);
}

TEST(RobotFile, KnowsWhereItsRowsStand) {
  const std::string text = "number_link 2 m 1, 2 # kg\nd 0\n 0.4 gz 9.81\nstop\n";
  const RobotFile file = parse(text);
  std::vector<std::string> rows;
  for (const RowText& row : file.texts) rows.push_back(text.substr(row.begin, row.end - row.begin));
  EXPECT_EQ(rows,
            (std::vector<std::string>{"number_link 2", "m 1, 2", "d 0\n 0.4", "gz 9.81", "stop"}));
}

TEST(RobotFile, ReadsTheFormOfAppendixB) {
  const RobotFile file = read_golden("thesis_appendix_b.robot");
  EXPECT_EQ(file.name, "thesis_appendix_b");
  EXPECT_EQ(file.joint_count, 3);
  EXPECT_TRUE(holds(file, RowKey::kR, {0, numeric(149, 1000), 0}));
  EXPECT_TRUE(holds(file, RowKey::kAl, {Pi / 2, 0, -Pi / 2}));
  EXPECT_TRUE(holds(file, RowKey::kXX, {0, 0, numeric("-1939918/10000000")}));
  EXPECT_TRUE(holds(file, RowKey::kYY, {numeric("23046964/1000000000"), 0, 0}))
      << "runs on over the line end";
  EXPECT_TRUE(holds(file, RowKey::kMY, {0, numeric("3011657/100000000"), 0}))
      << "begins on a shared line and runs on";
  EXPECT_TRUE(holds(file, RowKey::kGx, {0})) << "three rows on a line";
  EXPECT_TRUE(holds(file, RowKey::kGz, {numeric(981, 100)}));
  EXPECT_TRUE(file.row(RowKey::kZZ).values[1].unknown);
  ASSERT_EQ(file.warnings.size(), 2U) << "negative values that the thesis prints";
  EXPECT_EQ(file.warnings[0].position.line, 20) << "Fv";
  EXPECT_EQ(file.warnings[1].position.line, 10) << "XX, which is a base parameter";
}

TEST(RobotFile, KeepsThePlaceOfEveryField) {
  const RobotFile file = parse("number_link 2\nd 0\n   -.5 gz 9.81\nstop");
  const Row& d = file.row(RowKey::kD);
  EXPECT_EQ(d.keyword.line, 2);
  EXPECT_EQ(d.keyword.column, 1);
  EXPECT_EQ(d.values[1].position.line, 3);
  EXPECT_EQ(d.values[1].position.column, 4);
  EXPECT_EQ(d.values[1].length, 3);
  EXPECT_EQ(file.row(RowKey::kGz).values[0].position.column, 11);
}

TEST(RobotFile, KeepsTheTextAsGiven) {
  const std::string text = "number_link 1 # \xff\r\ngz 0\r\nstop\r\n";
  EXPECT_EQ(parse(text).text, text);
  EXPECT_EQ(parse(text).file_name, "arm.robot");
}

TEST(RobotFile, AbsentRowsAreEmpty) {
  const RobotFile file = parse("number_link 2\ngz 9.81\nstop\n");
  EXPECT_FALSE(file.row(RowKey::kD).present);
  EXPECT_TRUE(file.row(RowKey::kD).values.empty());
  EXPECT_TRUE(file.joint_names.empty());
}

TEST(RobotFile, LetNamesMayUseEarlierOnesAndBeUsedByOthersOnly) {
  const RobotFile file = parse("number_link 1\nlet a 0.1\nlet b 2*a\nd b^2\ngz 9.81\nstop\n");
  EXPECT_TRUE(holds(file, RowKey::kD, {numeric(1, 25)}));
}

TEST(RobotFile, UnusedIsNotSaidOfANameInAWrongRow) {
  const std::string errors = errors_of("number_link 1\nlet L 1\nfoo 3 L\ngz 9.81\nstop\n");
  EXPECT_NE(errors.find("unknown keyword 'foo'"), std::string::npos);
  EXPECT_EQ(errors.find("never used"), std::string::npos) << errors;
}

TEST(RobotFile, KeywordsAreReadInAnyCaseAndLetNamesAreNot) {
  const RobotFile file =
      parse("NUMBER_LINK 1\nLet l 1\nlet L 2\nSIGMA 1\nmx l\nMY L\nDH Standard\nGZ 0\nSTOP\n");
  EXPECT_TRUE(holds(file, RowKey::kMX, {1}));
  EXPECT_TRUE(holds(file, RowKey::kMY, {2}));
  EXPECT_EQ(file.convention, DhConvention::kStandard);
}

TEST(RobotFile, NameComesFromTheStemWhereNoRowStands) {
  const std::string text = "number_link 1\ngz 9.81\nstop\n";
  EXPECT_EQ(parse_robot_file(text, "robots/arm2.robot").name, "arm2");
  EXPECT_EQ(parse_robot_file(text, "a/my-arm.v2.robot").name, "my_arm_v2");
  EXPECT_EQ(parse_robot_file(text, "6dof.robot").name, "r6dof");
  EXPECT_EQ(parse_robot_file(text, "r\xc3\xa9.robot").name, "r__");
  EXPECT_EQ(parse_robot_file(text, "").name, "robot");
  EXPECT_EQ(parse_robot_file("name x\n" + text, "arm2.robot").name, "x");
}

TEST(RobotFile, JointCountHasItsBounds) {
  EXPECT_EQ(parse("number_link 100\ngz 0\nstop\n").joint_count, 100);
  EXPECT_EQ(parse("number_link 2*3\ngz 0\nstop\n").joint_count, 6);
  for (const std::string n : {"0", "101", "-1", "1.5", "pi", "1e300"}) {
    EXPECT_NE(errors_of("number_link " + n + "\ngz 0\nstop\n").find("arm.robot:1:13: error:"),
              std::string::npos)
        << n;
  }
}

TEST(RobotFile, UnknownIsAllowedInParameterRowsOnly) {
  const std::string end = " *\ngz 0\nstop\n";
  for (std::size_t i = 0; i < kRowKeyCount; ++i) {
    const auto key = static_cast<RowKey>(i);
    if (key == RowKey::kGz) continue;
    const std::string row(row_keyword(key));
    const bool geometry = row == "sigma" || row == "al" || row == "th" || row == "ant";
    const bool limit = row == "qmin" || row == "qmax" || row.ends_with("max");
    const bool allowed = !geometry && !limit;
    EXPECT_EQ(errors_of("number_link 1\n" + row + end).empty(), allowed) << row;
  }
}

TEST(RobotFile, RowsFollowTheOrderOfTheKeys) {
  EXPECT_EQ(row_keyword(RowKey::kSigma), "sigma");
  EXPECT_EQ(row_keyword(RowKey::kAnt), "ant");
  EXPECT_EQ(row_keyword(RowKey::kXX), "XX");
  EXPECT_EQ(row_keyword(RowKey::kMX), "mX");
  EXPECT_EQ(row_keyword(RowKey::kM), "m");
  EXPECT_EQ(row_keyword(RowKey::kIA), "IA");
  EXPECT_EQ(row_keyword(RowKey::kOff), "off");
  EXPECT_EQ(row_keyword(RowKey::kTaumax), "taumax");
  EXPECT_EQ(row_keyword(RowKey::kGz), "gz");
}

TEST(RobotFile, ExactAnglesGiveNoWarning) {
  EXPECT_TRUE(parse("number_link 6\nal 0 pi/2 -90*deg 3*pi/2 pi/4 1.2\nth 0 1e-2 2*pi -3*pi 6 1\n"
                    "gz 9.81\nstop\n")
                  .warnings.empty());
}

TEST(RobotFile, AMillionCharactersInALineAreRead) {
  const std::string blanks(1000000, ' ');
  EXPECT_EQ(
      parse("number_link 1\nd" + blanks + "0.5" + blanks + "# x\ngz 9.81\nstop\n").joint_count, 1);
  EXPECT_NE(errors_of("number_link 1\nd 0 " + std::string(1000000, 'x') + "\ngz 0\nstop\n"), "");
  std::string zeros = "number_link 1\nd";
  for (int i = 0; i < 200000; ++i) zeros += " 0";
  EXPECT_NE(errors_of(zeros + "\ngz 0\nstop\n").find("expected 1 value in 'd', found 200000"),
            std::string::npos);
}

TEST(RobotFile, MessagesStayShortWhateverTheTextIs) {
  const std::string name(1000000, 'x');
  for (const std::string& row :
       {"name " + name + "-", "let " + name + " 1", name + " 1", "d " + name, "d 1" + name,
        "d " + name + "(1)", "joints " + name + "-", "effect " + name + "= 1",
        "effect e " + name + "=" + name, "dh " + name, "let " + name + " " + name}) {
    const std::string errors = errors_of("number_link 1\n" + row + "\ngz 0\nstop\n");
    EXPECT_NE(errors, "") << row.substr(0, 10);
    EXPECT_LT(errors.size(), 3000U) << row.substr(0, 10);
  }
}

TEST(RobotFile, UnreadableFilesAreNamedWithTheReason) {
  const auto error_of = [](const std::string& path) -> std::string {
    try {
      read_robot_file(path);
      return "";
    } catch (const ModelError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(error_of("no/such.robot"),
            "no/such.robot: error: cannot read: No such file or directory\n");
  EXPECT_EQ(error_of("."), ".: error: cannot read: Is a directory\n");
}

TEST(RobotFile, ReadsFromDiskWhatItReadsFromText) {
  const std::string text = "number_link 1\r\nd L\ngz 9.81\nstop\n";
  const std::filesystem::path path =
      std::filesystem::path(testing::TempDir()) / "dyngen_robot_file_test.robot";
  std::ofstream(path, std::ios::binary) << text;
  try {
    read_robot_file(path.string());
    ADD_FAILURE() << "L is unknown";
  } catch (const ModelError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ":2:3: error: "))
        << error.what();
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace dyngen
