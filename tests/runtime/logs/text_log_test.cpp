// SPDX-License-Identifier: MIT
// Texts of all kinds. Numbers, names and units are those that a person reads in the text.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "tests/runtime/logs/read_log.h"

namespace dyngen::test {
namespace {

using runtime::LogTextSettings;
using testing::ElementsAre;
using testing::HasSubstr;

using Names = std::vector<std::string>;
using Rows = std::vector<std::vector<double>>;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void expect_rows(const WholeTable& table, const Rows& rows) {
  ASSERT_EQ(table.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(table.rows[i].size(), rows[i].size()) << "row " << i;
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      EXPECT_TRUE(same_number(table.rows[i][k], rows[i][k]))
          << "row " << i << ", column " << table.columns[k] << ": " << table.rows[i][k]
          << ", expected " << rows[i][k];
    }
  }
}

struct TextCase {
  const char* what;
  std::string text;
  Names columns, units;
  Rows rows;
};

const std::vector<TextCase> kTextCases = {
    {"commas",
     "time,q1,tau1\n0,1.5,-2\n0.1,2.5e-1,+3\n",
     {"time", "q1", "tau1"},
     {"", "", ""},
     {{0, 1.5, -2}, {0.1, 0.25, 3}}},
    {"no header", "0,1.5\n0.1,2\n", {"1", "2"}, {"", ""}, {{0, 1.5}, {0.1, 2}}},
    {"tabs, and a blank in a name",
     "t\tq 1\n0\t1\n1\t2\n",
     {"t", "q 1"},
     {"", ""},
     {{0, 1}, {1, 2}}},
    {"blanks of any number",
     "  t   q1\n  0   1.5\n 10  -2\n",
     {"t", "q1"},
     {"", ""},
     {{0, 1.5}, {10, -2}}},
    {"blanks, and units in names",
     "t [s] q1 [deg]\n0 1\n1 2\n",
     {"t", "q1"},
     {"s", "deg"},
     {{0, 1}, {1, 2}}},
    {"bars", "t|q1\n0|1,5\n1|2,5\n", {"t", "q1"}, {"", ""}, {{0, 1.5}, {1, 2.5}}},
    {"semicolons and decimal commas",
     "Zeit [ms];A1 [°];M1 (Nm)\n0;-19,5;1\n2;-20,25;2\n",
     {"Zeit", "A1", "M1"},
     {"ms", "°", "Nm"},
     {{0, -19.5, 1}, {2, -20.25, 2}}},
    {"Latin-1", "t;A1 [\xB0]\n0;1\n1;2\n", {"t", "A1"}, {"", "°"}, {{0, 1}, {1, 2}}},
    {"quoted decimal commas",
     "time,q1\n\"0\",\"-0,25\"\n\"0,002\",\"1,5\"\n",
     {"time", "q1"},
     {"", ""},
     {{0, -0.25}, {0.002, 1.5}}},
    {"thousands, decimal comma",
     "t;x\n0;1.234,5\n1;-12.345.678,25\n",
     {"t", "x"},
     {"", ""},
     {{0, 1234.5}, {1, -12345678.25}}},
    {"thousands, decimal point",
     "t;x\n0;1,234.5\n1;12,345,678.25\n",
     {"t", "x"},
     {"", ""},
     {{0, 1234.5}, {1, 12345678.25}}},
    {"thousands by blanks",
     "t;x\n0;1 234,5\n1;2 000 000,25\n",
     {"t", "x"},
     {"", ""},
     {{0, 1234.5}, {1, 2000000.25}}},
    {"thousands by no-break blanks",
     "t;x\n0;1\xC2\xA0"
     "234,5\n1;2\xE2\x80\xAF"
     "000,25\n",
     {"t", "x"},
     {"", ""},
     {{0, 1234.5}, {1, 2000.25}}},
    {"thousands by apostrophes",
     "t;x\n0;1'234.5\n1;2'000.25\n",
     {"t", "x"},
     {"", ""},
     {{0, 1234.5}, {1, 2000.25}}},
    {"Fortran's exponents",
     "t x\n0.0D+00 1.5D-03\n0.1D+01 -2.5d2\n",
     {"t", "x"},
     {"", ""},
     {{0, 1.5e-3}, {1, -250}}},
    {"a line sep=", "sep=;\nt;x\n0;1\n1;2\n", {"t", "x"}, {"", ""}, {{0, 1}, {1, 2}}},
    {"a separator told, of another kind",
     "\"sep=|\"\nt|x\n0|1\n1|2\n",
     {"t", "x"},
     {"", ""},
     {{0, 1}, {1, 2}}},
    {"a row of units",
     "time,q1,tau1\n[s],[rad],[Nm]\n0,1,2\n1,2,3\n",
     {"time", "q1", "tau1"},
     {"s", "rad", "Nm"},
     {{0, 1, 2}, {1, 2, 3}}},
    {"a row of units without brackets",
     "time,q1,I1,x\ns,deg,A,-\n0,1,2,3\n1,2,3,4\n",
     {"time", "q1", "I1", "x"},
     {"s", "deg", "A", ""},
     {{0, 1, 2, 3}, {1, 2, 3, 4}}},
    {"units as names", "A,V\n0.5,1\n1.5,2\n", {"A", "V"}, {"", ""}, {{0.5, 1}, {1.5, 2}}},
    {"a preamble",
     "Recorded with Drive Studio 4.2\nDate: 28.11.2026, on the left robot\nRate;250;Hz\n\n"
     "t;q1;q2\n0;1;2\n1;2;3\n2;3;4\n",
     {"t", "q1", "q2"},
     {"", "", ""},
     {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}}},
    {"a preamble of keys and values before two columns",
     "Device,Left\nRate,1000\nOperator,me\ntime,tau\n0,1.5\n1,2.5\n2,3.5\n",
     {"time", "tau"},
     {"", ""},
     {{0, 1.5}, {1, 2.5}, {2, 3.5}}},
    {"names in a comment",
     "# made by hand\n# t q1 q2\n0 1 2\n1 2 3\n",
     {"t", "q1", "q2"},
     {"", "", ""},
     {{0, 1, 2}, {1, 2, 3}}},
    {"names and units in comments",
     "% t, q1\n% s, deg\n0, 1\n1, 2\n",
     {"t", "q1"},
     {"s", "deg"},
     {{0, 1}, {1, 2}}},
    {"separators at the ends", "t,x,\n0,1,\n1,2,\n", {"t", "x"}, {"", ""}, {{0, 1}, {1, 2}}},
    {"separators at the ends of rows", "t,x\n0,1,\n1,2,\n", {"t", "x"}, {"", ""}, {{0, 1}, {1, 2}}},
    {"CR LF and a byte order mark",
     "\xEF\xBB\xBFt,x\r\n0,1\r\n1,2\r\n",
     {"t", "x"},
     {"", ""},
     {{0, 1}, {1, 2}}},
    {"CR alone", "t,x\r0,1\r1,2\r", {"t", "x"}, {"", ""}, {{0, 1}, {1, 2}}},
    {"what is missing",
     "t,x,y\n0,nan,1\n1,-nan(ind),2\n2,#N/A,3\n3,1.#QNAN,4\n4,,5\n5,NULL,6\n6,inf,7\n7,8,9\n",
     {"t", "x", "y"},
     {"", "", ""},
     {{0, kNan, 1},
      {1, kNan, 2},
      {2, kNan, 3},
      {3, kNan, 4},
      {4, kNan, 5},
      {5, kNan, 6},
      {6, kNan, 7},
      {7, 8, 9}}},
    {"hexadecimal and truth",
     "t,status,on\n0,0x1F,true\n1,16#ff,FALSE\n2,2#101,True\n",
     {"t", "status", "on"},
     {"", "", ""},
     {{0, 31, 1}, {1, 255, 0}, {2, 5, 1}}},
    {"words",
     "t,mode,q\n0,run,1\n1,stop,2\n",
     {"t", "mode", "q"},
     {"", "", ""},
     {{0, kNan, 1}, {1, kNan, 2}}},
    {"indices are no units",
     "t,q[1],q[2],torque (est)\n0,1,2,3\n1,2,3,4\n",
     {"t", "q[1]", "q[2]", "torque (est)"},
     {"", "", "", ""},
     {{0, 1, 2, 3}, {1, 2, 3, 4}}},
    {"ISO times",
     "time,x\n2026-11-28T23:59:59.5Z,1\n2026-11-29T00:00:00.250000001Z,2\n",
     {"time", "x"},
     {"s", ""},
     {{0, 1}, {0.750000001, 2}}},
    {"ISO times with zones and commas",
     "time;x\n2026-11-28 10:00:00,5+01:00;1\n2026-11-28 10:00:01,5+00:00;2\n",
     {"time", "x"},
     {"s", ""},
     {{0, 1}, {3601, 2}}},
    {"German dates",
     "Zeit;x\n28.11.2026 10:00:00,250;1,5\n28.11.2026 10:00:00,254;2,5\n",
     {"Zeit", "x"},
     {"s", ""},
     {{0, 1.5}, {0.004, 2.5}}},
    {"American dates",
     "time,x\n11/28/2026 11:59:59.5 AM,1\n11/28/2026 12:00:00.5 PM,2\n",
     {"time", "x"},
     {"s", ""},
     {{0, 1}, {1, 2}}},
    {"times of day over midnight",
     "time x\n23:59:59.998 1\n00:00:00.002 2\n00:00:01 3\n",
     {"time", "x"},
     {"s", ""},
     {{0, 1}, {0.004, 2}, {1.002, 3}}},
    {"times of day with a third colon",
     "time x\n10:00:00:998 1\n10:00:01:002 2\n",
     {"time", "x"},
     {"s", ""},
     {{0, 1}, {0.004, 2}}},
    {"stamps in ns",
     "stamp,x\n1423155837204875566,1\n1423155837204875569,2\n",
     {"stamp", "x"},
     {"", ""},
     {{0, 1}, {3, 2}}},
    {"long stamps in s",
     "stamp,x\n1423155837.204875566,1\n1423155837.204875569,2\n",
     {"stamp", "x"},
     {"", ""},
     {{0, 1}, {3e-9, 2}}},
    {"one column", "tau [Nm]\n0,5\n0,25\n", {"tau"}, {"Nm"}, {{0.5}, {0.25}}},
    {"names that come again",
     "t,q,q\n0,1,2\n1,2,3\n",
     {"t", "q", "q (2)"},
     {"", "", ""},
     {{0, 1, 2}, {1, 2, 3}}},
    {"names that units tell apart",
     "t,A1 [deg],A1 [Nm]\n0,1,2\n1,2,3\n",
     {"t", "A1 [deg]", "A1 [Nm]"},
     {"", "deg", "Nm"},
     {{0, 1, 2}, {1, 2, 3}}},
    {"names of two levels",
     "time,joint,joint,vel\n,a,b,a\n0,1,2,3\n1,2,3,4\n",
     {"time", "joint.a", "joint.b", "vel.a"},
     {"", "", "", ""},
     {{0, 1, 2, 3}, {1, 2, 3, 4}}},
    {"LabVIEW's header",
     "LabVIEW Measurement\t\nSeparator\tTab\n***End_of_Header***\t\n\nChannels\t2\t\t\n"
     "Samples\t5\t5\t\nDate\t2026/11/28\t2026/11/28\t\nX0\t0.0\t0.0\t\nDelta_X\t1\t1\t\n"
     "***End_of_Header***\t\t\t\nX_Value\tq1\ttau1\tComment\n0\t1\t2\n1\t2\t3\n2\t3\t4\n"
     "3\t4\t5\n4\t5\t6\n5\t6\t7\n",
     {"X_Value", "q1", "tau1"},
     {"", "", ""},
     {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 5}, {4, 5, 6}, {5, 6, 7}}},
    {"the header comes again", "t,x\n0,1\nt,x\n1,2\n", {"t", "x"}, {"", ""}, {{0, 1}, {1, 2}}},
    {"the last row is cut off",
     "t,x,y\n0,1,2\n1,2,3\n2,3",
     {"t", "x", "y"},
     {"", "", ""},
     {{0, 1, 2}, {1, 2, 3}}},
};

class TextOfKind : public testing::TestWithParam<TextCase> {};

TEST_P(TextOfKind, IsReadAsItIsMeant) {
  const TextCase& one = GetParam();
  SCOPED_TRACE(one.what);
  const WholeLog log = read_text(one.text);
  ASSERT_EQ(log.tables.size(), 1U);
  EXPECT_EQ(log.tables[0].columns, one.columns);
  EXPECT_EQ(log.tables[0].units, one.units);
  expect_rows(log.tables[0], one.rows);
}

TEST_P(TextOfKind, IsTheSameInUtf16) {
  const TextCase& one = GetParam();
  SCOPED_TRACE(one.what);
  if (one.text.find('\xB0') != std::string::npos && one.text.find("\xC2") == std::string::npos) {
    return;  // Latin-1 alone
  }
  for (const bool big : {false, true}) {
    std::string text = big ? std::string("\xFE\xFF") : std::string("\xFF\xFE");
    for (std::size_t i = one.text.starts_with("\xEF") ? 3 : 0; i < one.text.size(); ++i) {
      unsigned unit = static_cast<unsigned char>(one.text[i]);
      if (unit >= 0xE0) {
        unit = (unit & 0xFU) << 12 | (static_cast<unsigned char>(one.text[i + 1]) & 0x3FU) << 6 |
               (static_cast<unsigned char>(one.text[i + 2]) & 0x3FU);
        i += 2;
      } else if (unit >= 0xC0) {
        unit = (unit & 0x1FU) << 6 | (static_cast<unsigned char>(one.text[i + 1]) & 0x3FU);
        i += 1;
      }
      const char high = static_cast<char>(unit >> 8), low = static_cast<char>(unit & 0xFFU);
      text += big ? high : low;
      text += big ? low : high;
    }
    const WholeLog log = read_text(text);
    ASSERT_EQ(log.tables.size(), 1U);
    EXPECT_EQ(log.tables[0].columns, one.columns);
    EXPECT_EQ(log.tables[0].units, one.units);
    expect_rows(log.tables[0], one.rows);
    EXPECT_THAT(log.notices, HasSubstr("UTF-16"));
  }
}

INSTANTIATE_TEST_SUITE_P(Texts, TextOfKind, testing::ValuesIn(kTextCases));

TEST(TextLog, LinesArePlaces) {
  const WholeLog log = read_text("by hand\n\nt,x\n0,1\n# a comment\n1,2\n\n2,3\n");
  EXPECT_THAT(log.tables[0].places, ElementsAre(4, 6, 8));
  EXPECT_THAT(log.notices, HasSubstr("run.csv:5:1: warning: found a comment among the rows"));
}

TEST(TextLog, OriginSaysWhatWasTakenOff) {
  const auto log = runtime::open_log_bytes(
      "time,stamp,seconds,x\n2026-11-28T00:00:01Z,1423155837204875566,1423155837.204875566,1\n"
      "2026-11-28T00:00:02Z,1423155837204875567,1423155838.204875566,2\n",
      "run.csv");
  runtime::LogRows rows;
  ASSERT_TRUE(log->next(rows, 10));
  const auto time = log->origin(0, 0), stamp = log->origin(0, 1), seconds = log->origin(0, 2);
  ASSERT_TRUE(time && stamp && seconds);
  EXPECT_EQ(time->count, 1795824001000000000);  // 20785 days since 1970
  EXPECT_EQ(time->counts_per_unit, 1000000000);
  EXPECT_EQ(stamp->count, 1423155837204875566);
  EXPECT_EQ(stamp->counts_per_unit, 1);
  EXPECT_EQ(seconds->count, 1423155837204875566);
  EXPECT_EQ(seconds->counts_per_unit, 1000000000);
  EXPECT_FALSE(log->origin(0, 3));
  EXPECT_EQ(rows.values(1, 2), 1);
}

TEST(TextLog, SettingsSayWhatTheTextDoesNot) {
  LogTextSettings settings;
  settings.columns = Names{"t", "q1 [deg]"};
  WholeLog log = read_text("0,1\n1,2\n", settings);
  EXPECT_EQ(log.tables[0].columns, (Names{"t", "q1"}));
  EXPECT_EQ(log.tables[0].units, (Names{"", "deg"}));
  EXPECT_EQ(log.notices, "");

  settings = {};
  settings.decimal = '.';
  log = read_text("t;x\n0;1,234\n1;2,345\n", settings);
  expect_rows(log.tables[0], {{0, 1234}, {1, 2345}});
  log = read_text("t;x\n0;1,234\n1;2,345\n");
  expect_rows(log.tables[0], {{0, 1.234}, {1, 2.345}});
  EXPECT_THAT(log.notices, HasSubstr("'1,234' is read with a decimal comma"));

  settings = {};
  settings.skip_lines = 2;
  log = read_text("1,2\n3,4\nt,x\n5,6\n7,8\n", settings);
  EXPECT_EQ(log.tables[0].columns, (Names{"t", "x"}));
  expect_rows(log.tables[0], {{5, 6}, {7, 8}});

  settings = {};
  settings.separator = ' ';
  log = read_text("1,5 2,5\n3,5 4,5\n", settings);
  expect_rows(log.tables[0], {{1.5, 2.5}, {3.5, 4.5}});
}

TEST(TextLog, SignalsWithTimesOfTheirOwnAreTables) {
  const WholeLog log =
      read_text("Time [ms];A1 [deg];Time [ms];M1 [Nm]\n0;1,5;0;10\n2;2,5;1;11\n;;2;12\n;;3;13\n");
  ASSERT_EQ(log.tables.size(), 2U);
  EXPECT_EQ(log.tables[0].name, "A1");
  EXPECT_EQ(log.tables[0].columns, (Names{"Time", "A1"}));
  EXPECT_EQ(log.tables[0].units, (Names{"ms", "deg"}));
  expect_rows(log.tables[0], {{0, 1.5}, {2, 2.5}});
  EXPECT_EQ(log.tables[1].name, "M1");
  expect_rows(log.tables[1], {{0, 10}, {1, 11}, {2, 12}, {3, 13}});
  EXPECT_THAT(log.tables[1].places, ElementsAre(2, 3, 4, 5));
}

TEST(TextLog, TraceOfAControllerHasItsNamesInRowsOfKeys) {
  const WholeLog log = read_text(
      "Name\tScope\nFile\tC:\\trace.csv\nStart\t132\n\n"
      "Name\tAxis 1.ActPos\tName\tAxis 1.ActTorque\n"
      "SymbolComment\t\tSymbolComment\t\n"
      "Unit\tdeg\tUnit\tNm\n"
      "SampleTime[ms]\t1\tSampleTime[ms]\t2\n"
      "0\t1.5\t0\t10\n1\t2.5\t2\t11\n2\t3.5\n3\t4.5\n");
  ASSERT_EQ(log.tables.size(), 2U);
  EXPECT_EQ(log.tables[0].name, "Axis 1.ActPos");
  EXPECT_EQ(log.tables[0].columns, (Names{"time", "Axis 1.ActPos"}));
  EXPECT_EQ(log.tables[0].units, (Names{"", "deg"}));
  expect_rows(log.tables[0], {{0, 1.5}, {1, 2.5}, {2, 3.5}, {3, 4.5}});
  EXPECT_EQ(log.tables[1].units, (Names{"", "Nm"}));
  expect_rows(log.tables[1], {{0, 10}, {2, 11}});
}

TEST(TextLog, TopicAsTextKeepsItsNamesAndSaysNanoseconds) {
  const WholeLog log = read_text(
      "%time,field.header.seq,field.header.stamp,field.header.frame_id,field.name0,field."
      "position0\n"
      "1423155837204875566,0,1423155837204000000,,a,-0.25\n"
      "1423155837206875566,1,1423155837206000000,,a,-0.5\n");
  ASSERT_EQ(log.tables.size(), 1U);
  EXPECT_EQ(log.tables[0].units, (Names{"ns", "", "ns", "", "", ""}));
  expect_rows(log.tables[0], {{0, 0, 0, kNan, kNan, -0.25}, {2e6, 1, 2e6, kNan, kNan, -0.5}});
  EXPECT_THAT(log.notices, HasSubstr("words stand in 'field.name0'"));
}

struct RefusedText {
  const char* text;
  const char* message;
};

TEST(TextLog, WhatCannotBeMeantIsRefusedWithItsPlace) {
  const std::vector<RefusedText> cases = {
      {"", "run.csv: error: found no lines to read"},
      {"a poem\nof two lines\n", "run.csv:1:1: error: found no row of numbers in 2 lines"},
      {"t,x\n0,1\n1,2,3\n2,3\n3,4\n", "run.csv:3:5: error: found 3 values, expected 2"},
      {"t,x\n0,1\n1\n2,3\n3,4\n", "run.csv:3:2: error: found 1 values, expected 2"},
      {"t,x\n0,001,1,5\n0,002,1,25\n",
       "run.csv:1:1: error: found 2 names before rows of 4 values (line 2)"},
      {"t;x\n0;1,5\n1;1.5\n",
       "run.csv:3:1: error: found '1.5' (line 3) and '1,5' (line 2), expected one decimal sign"},
      {"t,x\n0,1\n1,\0", "run.csv:3:3"},
  };
  for (const RefusedText& one : cases) {
    SCOPED_TRACE(one.text);
    if (std::string(one.message) == "run.csv:3:3") {
      EXPECT_THAT(error_of(std::string("t,x\n0,1\n1,\0\n", 12), "run.csv"),
                  HasSubstr("run.csv:3:3: error: found a NUL byte"));
      continue;
    }
    EXPECT_THAT(error_of(one.text, "run.csv"), HasSubstr(one.message));
  }
}

TEST(TextLog, AWordThatIsNoNumberHasNoValueAndIsTold) {
  std::string text = "t,x\n";
  for (int i = 0; i < 1000; ++i) text += std::to_string(i) + (i == 900 ? ",ERR\n" : ",1\n");
  const WholeLog log = read_text(text);
  ASSERT_EQ(log.tables[0].rows.size(), 1000U);
  EXPECT_TRUE(same_number(log.tables[0].rows[900][1], kNan));
  EXPECT_THAT(log.notices,
              HasSubstr("run.csv:902:5: warning: found 'ERR' in 'x', expected a number"));
}

TEST(TextLog, ANumberWithTheOtherDecimalSignIsRefused) {
  std::string text = "t;x\n";
  for (int i = 0; i < 1000; ++i) text += std::to_string(i) + (i == 900 ? ";2,5\n" : ";1.5\n");
  EXPECT_THAT(
      error_of(text, "run.csv"),
      HasSubstr("run.csv:902:5: error: found '2,5' in 'x', expected a number with '.' before "
                "decimals, as in '1.5'"));
}

TEST(TextLog, AFieldInQuotesMayGoOnOverLines) {
  const WholeLog log = read_text(
      "t,note,\"q1\n[deg]\"\n0,\"begins\nand ends\",1.5\n1,\"a \"\"word\"\"\n\nmore\",2\n2,,3\n");
  ASSERT_EQ(log.tables.size(), 1U);
  EXPECT_THAT(log.tables[0].columns, ElementsAre("t", "note", "q1"));
  EXPECT_EQ(log.tables[0].units[2], "deg");
  EXPECT_THAT(log.tables[0].column("q1"), ElementsAre(1.5, 2, 3));
  EXPECT_THAT(log.tables[0].places, ElementsAre(3, 5, 8));
  EXPECT_THAT(log.notices, HasSubstr("goes on over several lines; read as one line (3 such"));
  // quotes that end no field are signs like others
  const WholeLog stray =
      read_text("t,note,q1\n0,\"5\" pipe,1\n1,6\" pipe,2\n2,\"open,3\n3,x,4\n4,y,5\n");
  EXPECT_THAT(stray.tables[0].column("t"), ElementsAre(0, 1, 2, 3, 4));
}

/// Rows of one form; the last one is cut off after so many signs.
std::string cut_text(int rows, std::size_t off) {
  std::string text = "t,q1\n";
  for (int k = 0; k < rows; ++k) {
    text += std::to_string(k) + "," + std::to_string(0.25 * k + 0.123456) + "\n";
  }
  return text.substr(0, text.size() - 1 - off);
}

TEST(TextLog, ALastNumberThatIsCutOffIsLeftOut) {
  for (const std::size_t off : {1U, 4U, 6U, 7U}) {
    const WholeLog log = read_text(cut_text(40, off));
    EXPECT_EQ(log.tables[0].rows.size(), 39U) << off;
    EXPECT_THAT(log.notices, HasSubstr("run.csv:41:")) << off;
    EXPECT_THAT(log.notices, HasSubstr("the last row is cut off")) << off;
  }
  // a file may end without an end of line
  EXPECT_EQ(read_text(cut_text(40, 0)).tables[0].rows.size(), 40U);
  // few rows of many forms tell nothing
  EXPECT_EQ(read_text("t,q1\n0,1.25\n1,0.5\n2,3").tables[0].rows.size(), 3U);
  std::string many = "t,count\n";
  for (int k = 0; k < 120; ++k) many += std::to_string(k) + "," + std::to_string(5000 + k) + "\n";
  EXPECT_EQ(read_text(many.substr(0, many.size() - 2)).tables[0].rows.size(), 119U);
  EXPECT_EQ(read_text(many + "120,1e").tables[0].rows.size(), 120U);
}

TEST(TextLog, PiecesMakeNoDifference) {
  std::string text = "Time;A;Time;B\n";
  for (int i = 0; i < 2000; ++i) {
    text += std::to_string(i) + ";1,5;" + (i < 1500 ? std::to_string(2 * i) + ";2,5\n" : ";\n");
  }
  const auto one = runtime::open_log_bytes(text, "run.csv");
  const WholeLog whole = read_whole(*one, 1 << 20);
  for (const std::size_t at_most : {1U, 13U, 500U}) {
    const auto other = runtime::open_log_bytes(text, "run.csv");
    const WholeLog pieces = read_whole(*other, at_most);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_EQ(pieces.tables[i].rows, whole.tables[i].rows);
      EXPECT_EQ(pieces.tables[i].places, whole.tables[i].places);
    }
  }
  EXPECT_EQ(whole.tables[1].rows.size(), 1500U);
}

}  // namespace
}  // namespace dyngen::test
