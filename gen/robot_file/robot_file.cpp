// SPDX-License-Identifier: GPL-2.0-or-later
#include "gen/robot_file/robot_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "gen/diagnostic/utf8.h"
#include "gen/robot_file/row_reader.h"
#include "gen/robot_file/value_checks.h"

namespace dyngen {

namespace {

constexpr std::size_t kMaxBytes = std::size_t{16} << 20U;  // a robot file has kilobytes

/// The place of byte `offset` in a text that may be no text at all.
SourcePosition position_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  SourcePosition position{1, 1};
  std::size_t line_begin = 0;
  for (std::size_t i = before.find('\n'); i != before.npos; i = before.find('\n', i + 1)) {
    ++position.line;
    line_begin = i + 1;
  }
  position.column += character_count(before.substr(line_begin));
  return position;
}

/// Reports bytes on which reading row by row would make no sense.
void check_is_text(std::string_view text, Diagnostics& diagnostics) {
  const std::size_t nul = text.find('\0');
  if (nul != text.npos) {
    diagnostics.error(position_of(text, nul), 1,
                      "NUL byte: this is a binary file, not a robot file",
                      "a robot file is plain text, not UTF-16");
    return;
  }
  for (std::size_t i = text.find('\r'); i != text.npos; i = text.find('\r', i + 1)) {
    if (i + 1 < text.size() && text[i + 1] == '\n') continue;
    diagnostics.error(position_of(text, i), 1, "carriage return without a line feed",
                      "save the file with Unix (LF) or Windows (CR LF) line ends");
    return;
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != text.npos && text[first] == '<') {
    diagnostics.error(position_of(text, first), 1, "this is XML, not a robot file",
                      "URDF and other XML is not read: write the DH table and the masses as rows");
    return;
  }
  if (first == text.npos) {
    diagnostics.error({1, 1}, 1, text.empty() ? "the file is empty" : "the file holds only blanks",
                      "a robot file begins with: number_link 6");
  }
}

void throw_if_errors(const Diagnostics& diagnostics) {
  if (diagnostics.has_errors()) throw ModelError(diagnostics.render());
}

[[noreturn]] void throw_unreadable(const std::string& path, const std::string& reason) {
  Diagnostics diagnostics(path, "");
  diagnostics.error({}, 1, "cannot read: " + reason);
  throw ModelError(diagnostics.render());
}

std::string read_bytes(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) {
    throw_unreadable(path, std::make_error_code(std::errc::is_a_directory).message());
  }
  errno = 0;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) throw_unreadable(path, std::generic_category().message(errno));
  std::string bytes;
  std::string block(std::size_t{1} << 16U, '\0');
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
    bytes.append(block, 0, count);
    if (bytes.size() > kMaxBytes) throw_unreadable(path, "larger than 16 MiB, no robot file");
  }
  if (std::ferror(file.get()) != 0) {
    throw_unreadable(path, std::generic_category().message(errno));
  }
  return bytes;
}

}  // namespace

RobotFile parse_robot_file(std::string text, std::string file_name, const FurtherCheck& further) {
  Diagnostics diagnostics(file_name, text);
  check_is_text(text, diagnostics);
  throw_if_errors(diagnostics);
  RobotFile file = read_rows(std::move(text), std::move(file_name), diagnostics);
  check_values(file, diagnostics);
  if (further) further(file, diagnostics);
  throw_if_errors(diagnostics);
  file.warnings = diagnostics.all();
  return file;
}

RobotFile read_robot_file(const std::string& path, const FurtherCheck& further) {
  return parse_robot_file(read_bytes(path), path, further);
}

}  // namespace dyngen
