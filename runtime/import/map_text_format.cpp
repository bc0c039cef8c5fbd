// SPDX-License-Identifier: MIT
#include "runtime/import/map_text_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <initializer_list>
#include <string>
#include <vector>

#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {
namespace {

constexpr std::size_t kMostSkippedLines = 100000;

/// "q{1..7}" as q1, q2, ... q7; any other name as it is.
std::vector<std::string> expanded(const std::vector<std::string>& names) {
  std::vector<std::string> all;
  for (const std::string& name : names) {
    const std::size_t open = name.find('{'), dots = name.find("..", open == name.npos ? 0 : open);
    const std::size_t close = name.find('}', dots == name.npos ? 0 : dots);
    int first = 0, last = 0;
    const auto read = [&](std::size_t from, std::size_t to, int& value) {
      return std::from_chars(name.data() + from, name.data() + to, value).ptr == name.data() + to;
    };
    const bool is_range = open != name.npos && dots != name.npos && close != name.npos &&
                          dots > open + 1 && close > dots + 2 && read(open + 1, dots, first) &&
                          read(dots + 2, close, last) && first <= last &&
                          last - first < kMostImportedJoints;
    if (!is_range) {
      all.push_back(name);
      continue;
    }
    for (int number = first; number <= last; ++number) {
      all.push_back(name.substr(0, open) + std::to_string(number) + name.substr(close + 1));
    }
  }
  return all;
}

char sign(const MapEntries& entries, const char* key, std::initializer_list<char> allowed,
          MapFaults& faults) {
  const std::string word = entries.text(key);
  if (word == "tab" || word == "\\t") return '\t';
  if (word == "blank" || word == "space") return ' ';
  if (word.size() == 1 && std::find(allowed.begin(), allowed.end(), word[0]) != allowed.end()) {
    return word[0];
  }
  std::string signs;
  for (const char c : allowed) {
    signs += fmt::format("{}{}", signs.empty() ? "" : ", ",
                         c == '\t'  ? "tab"
                         : c == ' ' ? "blank"
                                    : fmt::format("'{}'", c));
  }
  faults.add(entries.place_of_value(key), fmt::format("found {} in '{}', expected one of {}",
                                                      runtime::quoted(word), key, signs));
  return *allowed.begin();
}

}  // namespace

LogTextSettings read_text_settings(const MapEntries& entries, MapFaults& faults) {
  LogTextSettings settings;
  if (entries.has("separator")) {
    settings.separator = sign(entries, "separator", {',', ';', '|', ':', '\t', ' '}, faults);
  }
  if (entries.has("decimal")) settings.decimal = sign(entries, "decimal", {'.', ','}, faults);
  if (const auto skip = entries.number("skip", MapNumber::kRatio)) {
    if (*skip < 0 || *skip > static_cast<double>(kMostSkippedLines) ||
        *skip != static_cast<double>(static_cast<std::size_t>(*skip))) {
      faults.add(entries.place_of_value("skip"),
                 fmt::format("found skip: {}, expected a number of lines, 0 to {}", *skip,
                             kMostSkippedLines));
    } else {
      settings.skip_lines = static_cast<std::size_t>(*skip);
    }
  }
  if (entries.has("columns")) settings.columns = expanded(entries.texts("columns"));
  return settings;
}

}  // namespace dyngen::runtime
