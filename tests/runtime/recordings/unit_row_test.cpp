// SPDX-License-Identifier: MIT
// Units in a row below the header or in its names, and the ways to write a number.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/recordings/number_words.h"
#include "runtime/recordings/units.h"
#include "tests/runtime/recordings/recording_texts.h"

namespace dyngen::test {
namespace {

using runtime::ColumnQuantity;
using runtime::NumberStyle;
using runtime::Recording;
using runtime::unit_conversion;

struct Spelled {
  const char* word;
  ColumnQuantity quantity;
  double si;  ///< of one unit
};

TEST(Units, AreKnownAsProgramsWriteThem) {
  const double deg = M_PI / 180;
  const std::vector<Spelled> all = {{"s", ColumnQuantity::kTime, 1},
                                    {"[ms]", ColumnQuantity::kTime, 1e-3},
                                    {"msec", ColumnQuantity::kTime, 1e-3},
                                    {"\xC2\xB5s", ColumnQuantity::kTime, 1e-6},
                                    {"(ns)", ColumnQuantity::kTime, 1e-9},
                                    {"seconds", ColumnQuantity::kTime, 1},
                                    {"rad", ColumnQuantity::kPosition, 1},
                                    {"Deg", ColumnQuantity::kPosition, deg},
                                    {"[\xC2\xB0]", ColumnQuantity::kPosition, deg},
                                    {"\xB0", ColumnQuantity::kPosition, deg},  // Latin-1
                                    {"degrees", ColumnQuantity::kPosition, deg},
                                    {"m", ColumnQuantity::kPosition, 1},
                                    {" mm ", ColumnQuantity::kPosition, 1e-3},
                                    {"turns", ColumnQuantity::kPosition, 2 * M_PI},
                                    {"rad/s", ColumnQuantity::kVelocity, 1},
                                    {"\xC2\xB0/s", ColumnQuantity::kVelocity, deg},
                                    {"deg/sec", ColumnQuantity::kVelocity, deg},
                                    {"mm/s", ColumnQuantity::kVelocity, 1e-3},
                                    {"rpm", ColumnQuantity::kVelocity, 2 * M_PI / 60},
                                    {"rad s^-1", ColumnQuantity::kVelocity, 1},
                                    {"rad/s^2", ColumnQuantity::kAcceleration, 1},
                                    {"deg/s\xC2\xB2", ColumnQuantity::kAcceleration, deg},
                                    {"m/s2", ColumnQuantity::kAcceleration, 1},
                                    {"N m", ColumnQuantity::kTorque, 1},
                                    {"Nm", ColumnQuantity::kTorque, 1},
                                    {"N*m", ColumnQuantity::kTorque, 1},
                                    {"N\xC2\xB7m", ColumnQuantity::kTorque, 1},
                                    {"N.m", ColumnQuantity::kTorque, 1},
                                    {"mNm", ColumnQuantity::kTorque, 1e-3},
                                    {"mN m", ColumnQuantity::kTorque, 1e-3},
                                    {"N mm", ColumnQuantity::kTorque, 1e-3},
                                    {"Ncm", ColumnQuantity::kTorque, 1e-2},
                                    {"kN m", ColumnQuantity::kTorque, 1e3},
                                    {"N", ColumnQuantity::kTorque, 1},
                                    {"C", ColumnQuantity::kTemperature, 1}};
  for (const Spelled& spelled : all) {
    const auto found = unit_conversion(spelled.word, spelled.quantity);
    ASSERT_TRUE(found) << spelled.word;
    EXPECT_DOUBLE_EQ((*found)(1), spelled.si) << spelled.word;
  }
  EXPECT_DOUBLE_EQ((*unit_conversion("K", ColumnQuantity::kTemperature))(300), 300 - 273.15);
}

TEST(Units, OfAnotherQuantityAreNone) {
  EXPECT_FALSE(unit_conversion("rad", ColumnQuantity::kTime));
  EXPECT_FALSE(unit_conversion("deg", ColumnQuantity::kVelocity));
  EXPECT_FALSE(unit_conversion("rad/s", ColumnQuantity::kPosition));
  EXPECT_FALSE(unit_conversion("rad/s", ColumnQuantity::kAcceleration));
  EXPECT_FALSE(unit_conversion("A", ColumnQuantity::kTorque));
  EXPECT_FALSE(unit_conversion("%", ColumnQuantity::kTorque));
  EXPECT_FALSE(unit_conversion("MN m", ColumnQuantity::kTorque));
  EXPECT_FALSE(unit_conversion("", ColumnQuantity::kPosition));
  EXPECT_FALSE(unit_conversion("[]", ColumnQuantity::kPosition));
}

/// Twenty rows of one joint in degrees, milliseconds, mN m and degrees per second.
std::string in_degrees(const std::string& header, const std::string& units) {
  std::string text = header + "\n" + (units.empty() ? "" : units + "\n");
  for (int k = 0; k < 20; ++k) {
    text += std::to_string(2 * k) + "," + std::to_string(3 * k) + "," + std::to_string(500 * k) +
            "," + std::to_string(1500) + "\n";
  }
  return text;
}

TEST(Units, AreConvertedToSi) {
  struct Way {
    std::string text, notice;
  };
  const std::vector<Way> ways = {
      {in_degrees("time,q1,tau1,qd1", "ms,deg,mNm,deg/s"),
       "run.csv:2:1: warning: found a row of units: 'time' in ms; 'q1' in deg; 'tau1' in mNm; "
       "'qd1' "
       "in deg/s; converted to SI"},
      {in_degrees("time [ms],q1 [\xC2\xB0],tau1 [N mm],qd1 [\xC2\xB0/s]", ""),
       "run.csv:1:1: warning: found 'time [ms]' in ms; 'q1 [??]' in deg; 'tau1 [N mm]' in N mm; "
       "'qd1 "
       "[?"
       "?/s]' in deg/s; converted to SI"},
      {in_degrees("time_ms,q1_deg,tau1_mNm,qd1_deg/s", ""),
       "run.csv:1:1: warning: found 'time_ms' in ms; 'q1_deg' in deg; 'tau1_mNm' in mNm; "
       "'qd1_deg/s' "
       "in deg/s; converted to SI"},
      {in_degrees("Time (ms),Q1 (deg),Tau1,qd1 (deg/s)", ",,(mN m),-"), ""}};
  for (const Way& way : ways) {
    const ReadResult result = read_text(way.text);
    const Recording& recording = result.recording;
    ASSERT_EQ(recording.samples(), 20);
    for (Eigen::Index k = 0; k < 20; ++k) {
      const double i = static_cast<double>(k);
      EXPECT_EQ(recording.time(k), 2 * i / 1000);  // as if "0.014" had been read
      EXPECT_DOUBLE_EQ(recording.q(k, 0), 3 * i * M_PI / 180);
      EXPECT_DOUBLE_EQ(recording.tau(k, 0), i / 2);
      EXPECT_DOUBLE_EQ(recording.dq(k, 0), 1500 * M_PI / 180);
    }
    if (!way.notice.empty()) {
      EXPECT_EQ(result.notices, std::vector<std::string>{way.notice});
    }
  }
}

TEST(Units, OfSiAreReadToo) {
  std::vector<std::string> lines = plain_lines(20);
  const ReadResult plain = read_text(joined(lines));
  lines.insert(lines.begin() + 1, "[s],[rad],[rad],[Nm],[Nm]");
  const ReadResult result = read_text(joined(lines));
  EXPECT_TRUE(same(result.recording, plain.recording));
  EXPECT_EQ(result.notices, std::vector<std::string>{"run.csv:2:1: warning: found a row of units, "
                                                     "all of them SI; read"});
}

TEST(Units, MayStandInAComment) {
  const std::string rows = in_degrees("", "").substr(1);
  for (const std::string header : {"time,q1,tau1,qd1\n# ms,deg,mNm,deg/s\n",
                                   "# time,q1,tau1,qd1\n# [ms],[deg],[mNm],[deg/s]\n",
                                   "# time [ms],q1 [deg],tau1 [mNm],qd1 [deg/s]\n"}) {
    const ReadResult result = read_text(header + rows);
    ASSERT_EQ(result.recording.samples(), 20) << header;
    EXPECT_DOUBLE_EQ(result.recording.q(3, 0), 9 * M_PI / 180) << header;
    EXPECT_EQ(result.recording.time(7), 0.014) << header;
  }
}

TEST(Units, AreNotSeenInOtherNames) {
  std::vector<std::string> lines = plain_lines(20);
  lines[0] = "time,q1,q1_filtered,tau1,q1_ref";
  const ReadResult result = read_text(joined(lines));
  EXPECT_EQ(result.recording.joints(), 1);
  EXPECT_EQ(result.notices.size(), 2U);  // two columns that mean nothing
}

struct Written {
  const char* word;
  const char* line;
  NumberStyle style;
  const char* plain;
};

TEST(Numbers, AreReadInOneWayOnly) {
  const std::vector<Written> all = {
      {"0.5", "", NumberStyle::kPlain, "0.5"},
      {"-0,123", "x.y", NumberStyle::kPlain, "-0.123"},
      {"12,3456", "1.5", NumberStyle::kPlain, "12.3456"},
      {"1,234", "0,5;1,234", NumberStyle::kPlain, "1.234"},
      {"1,234", "0.5;1,234", NumberStyle::kAmbiguous, "1,234"},
      {"1,234.5", "", NumberStyle::kPlain, "1234.5"},
      {"1.234,5", "", NumberStyle::kPlain, "1234.5"},
      {"-12.345.678,25e-2", "", NumberStyle::kPlain, "-12345678.25e-2"},
      {"1,234,567", "", NumberStyle::kPlain, "1234567"},
      {"1.234.567", "", NumberStyle::kPlain, "1234567"},
      {"1,23,4", "", NumberStyle::kNone, "1,23,4"},
      {"12,34.5", "", NumberStyle::kNone, "12,34.5"},
      {"1.5.2", "", NumberStyle::kNone, "1.5.2"},
      {"0,123,456", "", NumberStyle::kNone, "0,123,456"}};
  for (const Written& written : all) {
    std::string word = written.word;
    EXPECT_EQ(runtime::use_decimal_point(word, written.line), written.style) << written.word;
    EXPECT_EQ(word, written.plain);
  }
}

TEST(Numbers, InQuotesMayHaveADecimalComma) {
  const ReadResult plain = read_text(joined(plain_lines(40)));
  std::vector<std::string> commas = plain_lines(40), semicolons = commas;
  for (std::vector<std::string>* lines : {&commas, &semicolons}) {
    const std::string between = lines == &commas ? "," : ";";
    for (std::string& line : *lines) {
      std::string quoted = "\"";
      for (const char c : line) {
        quoted += c == ',' ? "\"" + between + "\"" : std::string(1, c == '.' ? ',' : c);
      }
      line = quoted + "\"";
    }
  }
  EXPECT_TRUE(same(read_text(joined(commas)).recording, plain.recording));
  EXPECT_TRUE(same(read_text(joined(semicolons)).recording, plain.recording));
}

TEST(Numbers, AreCutWhereASpreadsheetSays) {
  const ReadResult plain = read_text(joined(plain_lines(40)));
  const std::string told =
      "run.csv:1:1: warning: found a line that says that columns are separated "
      "by ";
  for (const char separator : {',', ';', '|', '\t'}) {
    std::string text = joined(plain_lines(40));
    std::replace(text.begin(), text.end(), ',', separator);
    const ReadResult result = read_text("sep=" + std::string(1, separator) + "\r\n" + text);
    EXPECT_TRUE(same(result.recording, plain.recording)) << separator;
    EXPECT_EQ(result.notices.at(1).substr(0, told.size()), told);
  }
}

}  // namespace
}  // namespace dyngen::test
