// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace dyngen::test {

[[noreturn]] inline void fail(const char* claim, std::string_view detail) {
  std::fprintf(stderr, "violated: %s\n%.*s\n", claim, static_cast<int>(detail.size()),
               detail.data());
  std::abort();
}

/// Takes digits and a ':' from the front; false if they are not there.
inline bool take_number(std::string_view& text) {
  const std::size_t digits = text.find_first_not_of("0123456789");
  if (digits == 0 || digits == text.npos || text[0] == '0' || text[digits] != ':') return false;
  text.remove_prefix(digits + 1);
  return true;
}

/// `fuzz.robot:LINE:COLUMN: error: ...`, or `fuzz.robot: N more errors left out`
inline bool is_placed(std::string_view line, std::string_view file) {
  if (line.find(" left out") != line.npos && line.find("error:") == line.npos) return true;
  line.remove_prefix(file.size());
  if (line.empty() || line.front() != ':') return false;
  line.remove_prefix(1);
  if (!take_number(line) || !take_number(line)) return false;
  return line.starts_with(" error: ") || line.starts_with(" warning: ");
}

inline void check_message(std::string_view message, std::string_view file) {
  if (message.find(": error: ") == message.npos) fail("a ModelError has an error", message);
  while (!message.empty()) {
    const std::size_t end = message.find('\n');
    if (end == message.npos) fail("every line of a message ends", message);
    const std::string_view line = message.substr(0, end);
    if (line.starts_with(file)) {
      if (!is_placed(line, file)) fail("every message has line and column", line);
    } else if (line.find(" | ") == line.npos) {
      fail("every other line is an excerpt", line);
    }
    message.remove_prefix(end + 1);
  }
}

}  // namespace dyngen::test
