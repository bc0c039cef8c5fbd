// SPDX-License-Identifier: MIT
#include "runtime/recordings/notice.h"

#include <fmt/format.h>

namespace dyngen::runtime {

std::string Notice::text() const {
  if (line != 0 && place_word != "line") {
    return fmt::format("{}: {} {}: warning: {}", file, place_word, line, message);
  }
  std::string place = file;
  if (line != 0) place += fmt::format(":{}", line);
  if (line != 0 && column != 0) place += fmt::format(":{}", column);
  return fmt::format("{}: warning: {}", place, message);
}

}  // namespace dyngen::runtime
