// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/recordings/notice.h"

namespace dyngen::runtime {

/// "FILE:line:column: error: message"; line 0 names the file alone.
RecordingError recording_error(const std::string& file, std::size_t line, std::size_t column,
                               std::string_view message);

/// A piece of the user's text in quotes, fit to stand in a message: bytes that a terminal would not
/// print become '?', and a long piece is cut.
std::string quoted(std::string_view piece);

/// What was repaired in one file. Notices of one kind are summed up in the first of them.
class NoticeLog {
 public:
  /// @param place_word  what a place of the file is: "line", "message" or "row"
  NoticeLog(std::string file, std::size_t max_notices, std::string place_word = "line");

  /// A notice; later ones of the same `kind` only raise its count.
  void add(std::string_view kind, std::size_t line, std::size_t column, std::string message);

  /// A notice that says all of its kind: later ones are ignored.
  void add_once(std::string_view kind, std::size_t line, std::size_t column, std::string message);

  /// In the order in which they came, at most max_notices and one that says how many more.
  [[nodiscard]] std::vector<Notice> notices() const;

  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::string& place_word() const { return place_word_; }

  /// "FILE:line:column: error: message", or "FILE: message 17: error: ...".
  [[nodiscard]] RecordingError error(std::size_t line, std::size_t column,
                                     std::string_view message) const;

 private:
  struct Entry {
    std::string kind;
    Notice first;
    std::size_t more = 0;
    std::size_t last_line = 0;
  };
  Entry* find(std::string_view kind);

  std::string file_, place_word_;
  std::size_t max_notices_;
  std::vector<Entry> entries_;
  std::size_t left_out_ = 0;
};

}  // namespace dyngen::runtime
