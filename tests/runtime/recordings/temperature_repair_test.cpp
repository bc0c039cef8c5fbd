// SPDX-License-Identifier: MIT
#include "runtime/recordings/temperature_repair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/runtime/recordings/recording_texts.h"

namespace dyngen::test {
namespace {

using runtime::Notice;
using runtime::Recording;

/// 40 samples of two joints with further columns; `cells` gives the text of sample k.
template <typename Cells>
std::string with_temperatures(const std::string& header, const Cells& cells) {
  std::vector<std::string> lines = plain_lines(40);
  lines[0] += "," + header;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    lines[i] += "," + std::string(cells(static_cast<int>(i) - 1));
  }
  return joined(lines);
}

Recording repaired(const std::string& text, std::vector<Notice>& notices) {
  Recording recording = read_text(text).recording;
  repair_temperatures(recording, notices);
  return recording;
}

TEST(Temperatures, HaveTheirNamesWithAndWithoutANumber) {
  for (const char* header : {"temp", "Temperature", "temp1", "temp_1", "temperature_1[degC]"}) {
    const Recording recording =
        read_text(with_temperatures(header, [](int) { return "25"; })).recording;
    ASSERT_EQ(recording.temperature.cols(), 1) << header;
    EXPECT_EQ(recording.temperature(3, 0), 25) << header;
  }
}

TEST(Temperatures, OfAllJointsGiveWayToThoseOfJoints) {
  const ReadResult result =
      read_text(with_temperatures("temp,temp1,temp2", [](int) { return "20,25,26"; }));
  ASSERT_EQ(result.recording.temperature.cols(), 2);
  EXPECT_EQ(result.recording.temperature(3, 0), 25);
  ASSERT_EQ(result.notices.size(), 1U);
  EXPECT_NE(result.notices[0].find("beside temperatures of joints"), std::string::npos);
}

TEST(Temperatures, OfASlowSensorAreFilledAlongLines) {
  std::vector<Notice> notices;
  const Recording recording = repaired(
      with_temperatures("temp1,temp2",
                        [](int k) {
                          const std::string own = std::to_string(20 + k) + ",30";
                          return k % 10 == 5 ? own : std::string(k % 2 == 0 ? "," : "nan,nan");
                        }),
      notices);
  ASSERT_EQ(recording.samples(), 40);  // no row is bad for its temperature
  EXPECT_EQ(recording.run_starts, std::vector<Eigen::Index>{0});
  for (Eigen::Index k = 0; k < 40; ++k) {
    const double nearest = k < 5 ? 25 : k > 35 ? 55 : 20 + static_cast<double>(k);
    EXPECT_NEAR(recording.temperature(k, 0), nearest, 1e-9) << k;
    EXPECT_EQ(recording.temperature(k, 1), 30) << k;
  }
  ASSERT_EQ(notices.size(), 2U);
  EXPECT_NE(notices[0].message.find("temp1 has a value in 4 of 40 rows"), std::string::npos)
      << notices[0].message;
}

TEST(Temperatures, InKelvinsBecomeCelsius) {
  std::vector<Notice> notices;
  const Recording recording =
      repaired(with_temperatures("temp", [](int) { return "298.15"; }), notices);
  EXPECT_NEAR(recording.temperature(7, 0), 25, 1e-9);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_NE(notices[0].message.find("kelvins"), std::string::npos);
}

TEST(Temperatures, WithoutAValueAreLeftOut) {
  std::vector<Notice> notices;
  const Recording recording =
      repaired(with_temperatures("temp1,temp2", [](int) { return ",25"; }), notices);
  EXPECT_EQ(recording.samples(), 40);
  EXPECT_EQ(recording.temperature.size(), 0);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_NE(notices[0].message.find("no value in temp1"), std::string::npos);
}

TEST(Temperatures, OfAnotherNumberThanJointsAreTold) {
  std::vector<Notice> notices;
  (void)repaired(with_temperatures("temp1,temp2,temp3", [](int) { return "25,26,27"; }), notices);
  ASSERT_EQ(notices.size(), 1U);
  EXPECT_NE(notices[0].message.find("expected one for all joints"), std::string::npos);
}

TEST(Temperatures, MayBeAbsentBesideABadPosition) {
  std::vector<std::string> lines = plain_lines(40);
  lines[0] += ",temp";
  for (std::size_t i = 1; i < lines.size(); ++i) lines[i] += i == 2 ? ",25" : ",";
  lines[20] = "0.019,nan,-19,9.5,7,";
  const ReadResult result = read_text(joined(lines));
  ASSERT_EQ(result.recording.samples(), 40);
  EXPECT_NEAR(result.recording.q(19, 0), 19, 1e-9);
  EXPECT_TRUE(std::isnan(result.recording.temperature(19, 0)));
}

}  // namespace
}  // namespace dyngen::test
