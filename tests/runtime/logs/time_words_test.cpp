// SPDX-License-Identifier: MIT
#include "runtime/logs/time_words.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace dyngen::runtime {
namespace {

constexpr std::int64_t kNs = kNanosecondsPerSecond;
/// 2026-11-28T00:00:00Z
constexpr std::int64_t kMidnight = 1795824000 * kNs;
constexpr std::int64_t kHour = 3600 * kNs;

TEST(TimeWords, DatesAndTimesAreNanosecondsSince1970) {
  const std::vector<std::pair<const char*, std::int64_t>> words = {
      {"1970-01-01", 0},
      {"1969-12-31T23:59:59.5Z", -kNs / 2},
      {"2026-11-28", kMidnight},
      {"2026-11-28T10:00:00", kMidnight + 10 * kHour},
      {"2026-11-28 10:00:00.000000001", kMidnight + 10 * kHour + 1},
      {"2026-11-28T10:00:00.0000000019", kMidnight + 10 * kHour + 1},
      {"2026-11-28T10:00:00,25Z", kMidnight + 10 * kHour + kNs / 4},
      {"2026-11-28T10:00Z", kMidnight + 10 * kHour},
      {"20261128T100000Z", kMidnight + 10 * kHour},
      {"2026-11-28T10:00:00+05:30", kMidnight + 9 * kHour / 2},
      {"2026-11-28T10:00:00-0130", kMidnight + 23 * kHour / 2},
      {"2026/11/28 10:00:00", kMidnight + 10 * kHour},
      {"2026-11-28_10:00:00", kMidnight + 10 * kHour},
      {"28.11.2026 10:00:00,5", kMidnight + 10 * kHour + kNs / 2},
      {"11/28/2026 10:00:00 PM", kMidnight + 22 * kHour},
      {"11/28/2026 12:00:00 AM", kMidnight},
      {"2024-02-29", 1709164800 * kNs},
  };
  for (const auto& [word, nanoseconds] : words) {
    SCOPED_TRACE(word);
    const auto time = read_time_word(word);
    ASSERT_TRUE(time);
    EXPECT_EQ(time->kind, TimeWordKind::kInstant);
    EXPECT_EQ(time->nanoseconds, nanoseconds);
  }
}

TEST(TimeWords, TimesOfDayCountFromMidnight) {
  const std::vector<std::pair<const char*, std::int64_t>> words = {
      {"00:00:00", 0},
      {"10:00:00.25", 10 * kHour + kNs / 4},
      {"9:07:10", 9 * kHour + 430 * kNs},
      {"10:00:00:250", 10 * kHour + kNs / 4},
      {"07:10.5", 430 * kNs + kNs / 2},
      {"1:00:00 PM", 13 * kHour}};
  for (const auto& [word, nanoseconds] : words) {
    SCOPED_TRACE(word);
    const auto time = read_time_word(word);
    ASSERT_TRUE(time);
    EXPECT_EQ(time->kind, TimeWordKind::kTimeOfDay);
    EXPECT_EQ(time->nanoseconds, nanoseconds);
  }
}

TEST(TimeWords, OtherWordsAreNone) {
  for (const char* word : {"",
                           "1.5",
                           "1.234.567",
                           "-12.345",
                           "2026",
                           "20261128",
                           "10:70:00",
                           "25:00:00",
                           "2026-13-01",
                           "2026-02-30",
                           "1-2-3",
                           "10:00",
                           "2026-11-28T",
                           "2026-11-28T10:00:00X",
                           "12/28/2026 10:00",
                           "1e-5:3:2",
                           "9999-01-01",
                           "0001-01-01",
                           "a:b:c",
                           "10:00:00.",
                           "1.2.3.4"}) {
    EXPECT_FALSE(read_time_word(word)) << word;
  }
}

}  // namespace
}  // namespace dyngen::runtime
