// SPDX-License-Identifier: MIT
#include "tests/runtime/dynid/random_robot_text.h"

#include <fmt/format.h>

#include <array>
#include <random>
#include <vector>

namespace dyngen::test {
namespace {

class RobotWriter {
 public:
  explicit RobotWriter(std::uint64_t seed) : random_(seed) {}

  std::string text() {
    joints_ = 1 + pick(5);
    const bool tree = pick(4) == 0;
    std::string text = fmt::format("name arm\nnumber_link {}\n", joints_);
    if (pick(2) == 0) text += "dh standard\n";
    std::string sigma = "sigma", parent = "ant";
    for (int j = 1; j <= joints_; ++j) {
      const int kind = pick(10);
      const bool fixed = kind == 9 && j < joints_;  // something must move
      fixed_.push_back(fixed);
      sigma += fixed ? " 2" : kind >= 7 ? " 1" : " 0";
      parent += fmt::format(" {}", tree ? pick(j) : j - 1);
    }
    std::string rows = sigma + "\n";
    if (tree) rows += parent + "\n";
    rows += row("al", [&] { return angle(); }) + "\n" + row("th", [&] { return angle(); }) + "\n";
    rows += row("d", [&] { return length(); }) + "  " + row("r", [&] { return length(); }) + "\n";
    rows += "# what is known of the links\n";
    constexpr std::array<const char*, 10> kInertial = {"m",  "mX", "mY", "mZ", "XX",
                                                       "XY", "XZ", "YY", "YZ", "ZZ"};
    for (const char* key : kInertial) rows += dynamic_row(key, false);
    for (const char* key : {"IA", "Fs", "Fv", "off"}) rows += dynamic_row(key, true);
    const bool twice = rows.find("twice") != std::string::npos;
    if (twice || rows.find("mass") != std::string::npos) text += "let mass 1.5   # kg\n";
    if (twice) text += "let twice 2*mass\n";
    constexpr std::array<const char*, 4> kGravities = {"gz 9.81", "gx 9.81 gz 0", "gy -9.81",
                                                       "gx 1.2, gy 2.5 gz 9.3"};
    return text + rows + kGravities[static_cast<std::size_t>(pick(4))] +
           (pick(3) == 0 ? " " : "\n") + "stop\n";
  }

 private:
  int pick(int count) { return static_cast<int>(random_() % static_cast<std::uint64_t>(count)); }

  template <typename Value>
  std::string row(const char* key, const Value& value) {
    std::string text = key;
    for (int j = 0; j < joints_; ++j) text += " " + value();
    return text;
  }

  std::string angle() {
    constexpr std::array<const char*, 7> kAngles = {"0",  "0",    "pi/2",  "-pi/2",
                                                    "pi", "pi/3", "20*deg"};
    return kAngles[static_cast<std::size_t>(pick(7))];
  }
  std::string length() {
    return pick(2) == 0 ? "0" : fmt::format("{}", (pick(1600) - 800) / 1000.0);
  }

  std::string dynamic_row(const char* key, bool of_actuator) {
    const int way = pick(4);
    if (way == 0) return "";  // absent: unknown to dynid
    std::string text = key;
    for (int j = 0; j < joints_; ++j) {
      std::string value = "*";
      const int what = way == 1 ? 0 : pick(5);
      if (what == 1) value = "0";
      if (what == 2) value = fmt::format("{}", (1 + pick(900)) / 1000.0);
      if (what == 3) value = pick(2) == 0 ? "mass/4" : "twice*0.1";
      if (of_actuator && fixed_[static_cast<std::size_t>(j)]) value = "0";
      const bool on_next_line = j > 0 && value != "mass/4" && value != "twice*0.1" && pick(8) == 0;
      text += (on_next_line ? "  # goes on\n   " : pick(6) == 0 && j > 0 ? ", " : " ") + value;
    }
    return text + (pick(4) == 0 ? "  " : "\n");
  }

  std::mt19937_64 random_;
  int joints_ = 0;
  std::vector<bool> fixed_;
};

}  // namespace

std::string random_robot_text(std::uint64_t seed) { return RobotWriter(seed).text(); }

}  // namespace dyngen::test
