// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

namespace dyngen::runtime {

/// Something about a recording that its reader should know: what was repaired, what looks wrong.
struct Notice {
  std::string file;
  std::size_t line = 0;    ///< from 1; 0 where it speaks of the whole file
  std::size_t column = 0;  ///< from 1, in bytes; 0 where it speaks of the whole line
  std::string message;
  std::string place_word = "line";  ///< what `line` counts

  /// "run.csv:17:5: warning: ...", "run.db3: message 17: warning: ..."
  [[nodiscard]] std::string text() const;
};

/// A recording that cannot be read. what() is "run.csv:17:5: error: found ..., expected ...".
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dyngen::runtime
