// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/logs/raw_log.h"

namespace dyngen::runtime {

/// "FILE: error: message"
LogError log_error(const std::string& file, std::string_view message);

/// "FILE: error: byte 4711: message"; the word is "byte", "message" or "row", the number from 1.
LogError log_error_at(const std::string& file, std::string_view word, std::uint64_t place,
                      std::string_view message);

/// "FILE: error: reading MATLAB files needs libmatio-dev when dynid is built; ..."
LogError absent_package(const std::string& file, std::string_view what, std::string_view package);

/// "FILE: warning: message", as RawLog::notices() has them.
std::string log_notice(const std::string& file, std::string_view message);

/// A piece of the user's text in quotes, as quoted() has it. Its name keeps std::quoted() away.
std::string in_quotes(std::string_view piece);

/// Names for a sentence: "'a', 'b', 'c' and 4 more".
std::string few_names(const std::vector<std::string>& names);

}  // namespace dyngen::runtime
