// SPDX-License-Identifier: MIT
#include "runtime/logs/log_error.h"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/recordings/notice_log.h"

namespace dyngen::runtime {

LogError log_error(const std::string& file, std::string_view message) {
  return LogError(fmt::format("{}: error: {}", file, message));
}

LogError log_error_at(const std::string& file, std::string_view word, std::uint64_t place,
                      std::string_view message) {
  return LogError(fmt::format("{}: error: {} {}: {}", file, word, place, message));
}

LogError absent_package(const std::string& file, std::string_view what, std::string_view package) {
  return log_error(file,
                   fmt::format("reading {} needs {} when dynid is built; install it and build "
                               "dynid again",
                               what, package));
}

std::string log_notice(const std::string& file, std::string_view message) {
  return fmt::format("{}: warning: {}", file, message);
}

std::string in_quotes(std::string_view piece) { return quoted(piece); }

std::string few_names(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) {
    text += (i == 0 ? "" : ", ") + in_quotes(names[i]);
  }
  return names.size() > kShown ? fmt::format("{} and {} more", text, names.size() - kShown) : text;
}

}  // namespace dyngen::runtime
