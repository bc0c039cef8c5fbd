// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

namespace dyngen {

/// A line broken at blanks so that no part is longer; a word that is longer stays whole. What
/// follows the break stands below the text behind the line's last wide gap ("name    text"), else
/// two columns further in. Lines of messages with a place in a file ("arm.robot:4:7: error: ..."),
/// and the lines of the file that they show, stay as they are: other programs read them.
std::string fitted_line(std::string_view line, int columns);

/// How wide a line of the terminal may be: 80, or what DYNGEN_COLUMNS says.
int terminal_columns();

/// While it lives, what is written to a stream comes out in lines that fit the terminal. A line of
/// progress, which begins with a carriage return, comes out at once.
class FittedLines : public std::streambuf {
 public:
  explicit FittedLines(std::ostream& stream, int columns = terminal_columns());
  /// Writes what is left and gives the stream its buffer back.
  ~FittedLines() override;
  FittedLines(const FittedLines&) = delete;
  FittedLines& operator=(const FittedLines&) = delete;

 protected:
  int_type overflow(int_type character) override;
  std::streamsize xsputn(const char* text, std::streamsize count) override;
  int sync() override;

 private:
  bool write(std::string_view text);
  bool add(std::string_view text);

  std::ostream& stream_;
  std::streambuf* target_;
  int columns_;
  std::string pending_;  ///< a line without its end
};

}  // namespace dyngen
