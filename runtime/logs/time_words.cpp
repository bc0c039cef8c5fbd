// SPDX-License-Identifier: MIT
#include "runtime/logs/time_words.h"

#include <algorithm>
#include <chrono>

#include "runtime/recordings/columns.h"

namespace dyngen::runtime {
namespace {

constexpr int kFirstYear = 1700, kLastYear = 2250;  // what 64-bit nanoseconds hold
constexpr std::int64_t kSecondsPerHour = 3600, kSecondsPerMinute = 60;

struct ClockTime {
  std::int64_t nanoseconds = 0;
  int parts = 0;          ///< 2: mm:ss, 3: hh:mm:ss
  bool fraction = false;  ///< decimals of a second are written
};

/// Takes pieces off the front of a word.
class TimeScanner {
 public:
  explicit TimeScanner(std::string_view text) : text_(text) {}

  [[nodiscard]] bool at_end() const { return text_.empty(); }

  /// A number of `fewest` to `most` digits.
  std::optional<int> number(std::size_t fewest, std::size_t most) {
    std::size_t count = 0;
    int value = 0;
    while (count < most && count < text_.size() && text_[count] >= '0' && text_[count] <= '9') {
      value = 10 * value + (text_[count] - '0');
      ++count;
    }
    if (count < fewest) return std::nullopt;
    text_.remove_prefix(count);
    return value;
  }

  bool one_of(std::string_view signs) {
    if (text_.empty() || signs.find(text_.front()) == signs.npos) return false;
    text_.remove_prefix(1);
    return true;
  }

  /// The sign that comes next, without taking it.
  [[nodiscard]] char next() const { return text_.empty() ? '\0' : text_.front(); }

  /// Decimals of a second, in ns.
  std::optional<std::int64_t> fraction() {
    std::size_t count = 0;
    std::int64_t value = 0, weight = kNanosecondsPerSecond / 10;
    while (count < text_.size() && text_[count] >= '0' && text_[count] <= '9') {
      value += (text_[count] - '0') * weight;
      weight /= 10;
      ++count;
    }
    if (count == 0) return std::nullopt;
    text_.remove_prefix(count);
    return value;
  }

  void skip_blanks() { text_ = trimmed(text_); }

 private:
  std::string_view text_;
};

std::optional<std::int64_t> days_of(int year, int month, int day) {
  using namespace std::chrono;
  const year_month_day date{std::chrono::year(year),
                            std::chrono::month(static_cast<unsigned>(month)),
                            std::chrono::day(static_cast<unsigned>(day))};
  if (year < kFirstYear || year > kLastYear || !date.ok()) return std::nullopt;
  return sys_days(date).time_since_epoch().count();
}

/// The date at the front: days since 1970.
std::optional<std::int64_t> scan_date(TimeScanner& scan, bool has_half) {
  const auto first = scan.number(1, 4);
  if (!first) return std::nullopt;
  const char sign = scan.next();
  if (*first >= 1000 && (sign == '-' || sign == '/')) {
    scan.one_of("-/");
    const auto month = scan.number(1, 2);
    if (!month || scan.next() != sign || !scan.one_of("-/")) return std::nullopt;
    const auto day = scan.number(1, 2);
    return day ? days_of(*first, *month, *day) : std::nullopt;
  }
  if (*first >= 1000) {  // 20261128
    const auto month = scan.number(2, 2), day = scan.number(2, 2);
    return month && day ? days_of(*first, *month, *day) : std::nullopt;
  }
  if (sign != '.' && (sign != '/' || !has_half)) return std::nullopt;
  scan.one_of("./");
  const auto second = scan.number(1, 2);
  if (!second || scan.next() != sign || !scan.one_of("./")) return std::nullopt;
  const auto year = scan.number(4, 4);
  if (!year) return std::nullopt;
  return sign == '.' ? days_of(*year, *second, *first) : days_of(*year, *first, *second);
}

/// hh:mm:ss.fff, mm:ss.fff or hhmmss.fff
std::optional<ClockTime> scan_clock(TimeScanner& scan, bool after_date) {
  const auto first = scan.number(1, 2);
  if (!first) return std::nullopt;
  ClockTime clock{0, 3, false};
  int hours = *first, minutes = 0, seconds = 0;
  const bool colons = scan.one_of(":");
  const auto second = scan.number(2, 2);
  if (!second || (!colons && !after_date)) return std::nullopt;
  minutes = *second;
  if (!colons || scan.next() == ':') {
    if (colons) scan.one_of(":");
    const auto third = scan.number(2, 2);
    if (third) {
      seconds = *third;
    } else if (colons) {
      return std::nullopt;
    }
  } else if (!after_date) {
    clock.parts = 2;
  }
  if (scan.one_of(clock.parts == 3 && colons ? ".,:" : ".,")) {
    const auto fraction = scan.fraction();
    if (!fraction) return std::nullopt;
    clock.nanoseconds = *fraction;
    clock.fraction = true;
  }
  if (clock.parts == 2) {  // what was read as hours and minutes are minutes and seconds
    seconds = minutes;
    minutes = hours;
    hours = 0;
  }
  constexpr int kMostHours = 24, kMostSeconds = 60;  // midnight, and a leap second
  if (hours > kMostHours || minutes >= kSecondsPerMinute || seconds > kMostSeconds) {
    return std::nullopt;
  }
  clock.nanoseconds +=
      (hours * kSecondsPerHour + minutes * kSecondsPerMinute + seconds) * kNanosecondsPerSecond;
  return clock;
}

/// "Z", "+01:00", "+0100" or "+01" at the end: ns that the clock is ahead of UTC.
std::optional<std::int64_t> scan_zone(TimeScanner& scan) {
  if (scan.at_end() || scan.one_of("Zz")) return 0;
  const bool behind = scan.next() == '-';
  if (!scan.one_of("+-")) return std::nullopt;
  const auto hours = scan.number(2, 2);
  if (!hours) return std::nullopt;
  scan.one_of(":");
  const int minutes = scan.number(2, 2).value_or(0);
  const std::int64_t ahead =
      (*hours * kSecondsPerHour + minutes * kSecondsPerMinute) * kNanosecondsPerSecond;
  return behind ? -ahead : ahead;
}

/// Takes "AM" or "PM" off the end: what it adds to hours below 12.
std::optional<char> take_half_of_day(std::string_view& word) {
  if (word.size() < 3) return std::nullopt;
  const char last = word.back(), half = word[word.size() - 2];
  if (last != 'M' && last != 'm') return std::nullopt;
  if (half != 'A' && half != 'a' && half != 'P' && half != 'p') return std::nullopt;
  word = trimmed(word.substr(0, word.size() - 2));
  return half == 'P' || half == 'p' ? 'p' : 'a';
}

bool may_be_time(std::string_view word) {
  constexpr std::size_t kShortest = 5, kLongest = 48;
  if (word.size() < kShortest || word.size() > kLongest) return false;
  if (word.front() < '0' || word.front() > '9') return false;
  const auto count = [&](char c) { return std::count(word.begin(), word.end(), c); };
  return count(':') > 0 || count('-') > 1 || count('/') == 2 || count('.') >= 2 ||
         (word.size() > 8 && (word[8] == 'T' || word[8] == 't'));
}

}  // namespace

std::optional<TimeWord> read_time_word(std::string_view word) {
  word = trimmed(word);
  if (!may_be_time(word)) return std::nullopt;
  const std::optional<char> half = take_half_of_day(word);
  const auto in_half = [&](std::int64_t clock) {
    constexpr std::int64_t kHalfDay = kNanosecondsPerDay / 2;
    if (!half) return clock;
    if (clock >= kHalfDay) clock -= kHalfDay;  // 12 PM is noon, 12 AM is midnight
    return *half == 'p' ? clock + kHalfDay : clock;
  };

  TimeScanner scan(word);
  if (const auto days = scan_date(scan, half.has_value())) {
    TimeWord time{TimeWordKind::kInstant, *days * kNanosecondsPerDay};
    if (scan.at_end()) return time;
    if (!scan.one_of("Tt_- ")) return std::nullopt;
    scan.skip_blanks();
    const auto clock = scan_clock(scan, true);
    if (!clock) return std::nullopt;
    scan.skip_blanks();
    const auto ahead = scan_zone(scan);
    if (!ahead || !scan.at_end()) return std::nullopt;
    time.nanoseconds += in_half(clock->nanoseconds) - *ahead;
    return time;
  }
  scan = TimeScanner(word);
  const auto clock = scan_clock(scan, false);
  if (!clock || !scan.at_end() || (clock->parts == 2 && !clock->fraction)) return std::nullopt;
  return TimeWord{TimeWordKind::kTimeOfDay, in_half(clock->nanoseconds)};
}

}  // namespace dyngen::runtime
