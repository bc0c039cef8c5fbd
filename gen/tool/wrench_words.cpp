// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/tool/wrench_words.h"

#include <charconv>
#include <filesystem>
#include <stdexcept>

namespace dyngen {
namespace {

constexpr const char* kWrench = "--wrench";

bool may_be_link(const std::string& word) {
  std::error_code ignored;
  return !word.empty() && word[0] != '-' && word.find_first_of("./\\") == std::string::npos &&
         !std::filesystem::is_regular_file(word, ignored);
}

}  // namespace

std::vector<std::string> with_joined_wrench(int argc, const char* const* argv) {
  std::vector<std::string> words;
  for (int i = 0; i < argc; ++i) {
    words.emplace_back(argv[i]);
    if (words.back() != kWrench || i + 1 == argc || !may_be_link(argv[i + 1])) continue;
    words.back() += "=" + std::string(argv[i + 1]);
    ++i;
  }
  return words;
}

int wrench_link(const std::string& word, const RobotModel& model) {
  if (word == "true") return 0;
  int number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error == std::errc() && end == word.data() + word.size() && number >= 1 &&
      number <= model.size()) {
    return number;
  }
  std::string names;
  for (int j = 1; j <= model.size(); ++j) {
    if (model.joint(j).name == word) return j;
    names += (names.empty() ? "" : ", ") + model.joint(j).name;
  }
  throw std::invalid_argument("--wrench: " + model.name + " has no link '" + word +
                              "'; expected 1 to " + std::to_string(model.size()) +
                              ", or a joint's name: " + names);
}

}  // namespace dyngen
